#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/state/ring_field.h"

namespace wheelwright {

/// Fine enough for ParaView: at 28 x 384 cells a piece of a cut cell is about a millimetre wide.
inline constexpr int vtu_cut_subdivisions = 4;

/// The material of the full ring as cells for ParaView, with psi at their points, which the cells of a sector
/// share. Full cells are divided by the lattice's degree; cut cells are clipped at {psi = 0} on a grid of
/// `cut_subdivisions` squares along each axis and divided into triangles. Files of the same shape share one
/// mesh.
class VtuMesh {
 public:
  /// `lattice` carries the fields, on psi's grid. The numbers of grid and psi are written as they are:
  /// `length_unit` is theirs.
  VtuMesh(const LevelSet<2>& psi, const Lattice<2>& lattice, int cut_subdivisions,
          std::string_view length_unit = "m");
  ~VtuMesh();

  /// The bytes of a ParaView file with psi and nodal fields; a field's unit follows its name. Scalars,
  /// vectors (2 components) and symmetric tensors (xx, yy, zz, xy).
  std::string file(std::span<const NamedField> fields) const;

  /// Writes that file, atomically. Throws OutputError.
  void write(const std::filesystem::path& path, std::span<const NamedField> fields) const;

 private:
  struct Sector;

  std::vector<std::vector<float>> values(const RingField& field) const;  ///< one list per component
  std::vector<float> values(const RingField& field, int component) const;

  Lattice<2> lattice_;
  std::unique_ptr<Sector> sector_;
  std::string beginning_;  ///< of every file: what it says of the cells and psi
  std::string arrays_;     ///< their numbers
};

/// One file of a ParaView time collection.
struct PvdEntry {
  double time;       ///< what ParaView shows as time, e.g. the number of the shape
  std::string file;  ///< relative to the collection
  int part = 0;      ///< files of the same time are parts of one whole
  std::string name = "wheel";
};

/// Writes the collection, atomically. Throws OutputError.
void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries);

}  // namespace wheelwright
