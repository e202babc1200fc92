#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/output/report/field_points.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Fine enough for ParaView: in the plane, at 28 x 384 cells, a piece of a cut cell is about a millimetre
/// wide.
template <int dim>
inline constexpr int vtu_cut_subdivisions = dim == 2 ? 4 : 2;

/// The material of the full ring as cells for ParaView, with psi at their points, which the cells of a sector
/// share. Files of the same shape share one mesh. In 2D full cells are divided by the lattice's degree; cut
/// cells are clipped at {psi = 0} on a grid of `cut_subdivisions` squares along each axis and divided into
/// triangles. In 3D all cells are divided into `cut_subdivisions` cubes along each axis; cubes that are cut
/// become tetrahedra and wedges.
template <int dim>
class VtuMesh {
 public:
  /// `lattice` carries the fields, on psi's grid. The numbers of grid and psi are written unchanged, in
  /// `length_unit`. If the layers of materials of the rows of cells are given, the cells have their numbers
  /// as `material`, and points between layers are there once for each: fields may jump there (RingField).
  VtuMesh(const LevelSet<dim>& psi, const Lattice<dim>& lattice, int cut_subdivisions,
          std::string_view length_unit = "m", const std::vector<int>& layer_of_row = {});

  /// The bytes of a ParaView file with psi and nodal fields; a field's unit follows its name. Scalars,
  /// vectors (dim components) and symmetric tensors (xx, yy, zz, xy, in 3D also yz and xz).
  std::string file(std::span<const NamedField> fields) const;

  /// Writes that file, atomically. Throws OutputError.
  void write(const std::filesystem::path& path, std::span<const NamedField> fields) const;

 private:
  /// Passes the parts of a file on, which follow each other.
  template <class Take>
  auto with_parts(std::span<const NamedField> fields, const Take& take) const;

  FieldPoints<dim> points_;
  std::string beginning_;  ///< of every file: the part about the cells and psi
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
