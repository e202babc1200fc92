#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/state/ring_field.h"

namespace wheelwright {

/// Fine enough for ParaView: at 28 x 384 cells a piece of a cut cell is about a millimetre wide.
inline constexpr int vtu_cut_subdivisions = 4;

/// Writes the material of the full ring with psi and nodal fields as a ParaView file, atomically. Full cells
/// are divided by the lattice's degree; cut cells are clipped at {psi = 0} on a grid of
/// `cut_subdivisions` squares along each axis. `lattice` carries the fields, on psi's grid. A field of 2
/// components is written as a vector, any other as scalars. Throws OutputError.
void write_vtu(const std::filesystem::path& path, const LevelSet<2>& psi, const Lattice<2>& lattice,
               std::span<const NamedField> fields, int cut_subdivisions);

/// One file of a ParaView time collection.
struct PvdEntry {
  double time;       ///< what ParaView shows as time, e.g. the number of the shape
  std::string file;  ///< relative to the collection
};

/// Writes the collection, atomically. Throws OutputError.
void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries);

}  // namespace wheelwright
