#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// Columns of cells of the full ring, from `first` to before `last`; 0 <= first < last <= all columns.
struct ColumnRange {
  int first, last;
};

/// Whether a point of the body frame lies in these columns.
bool contains(const ColumnRange& columns, const PolarGrid<3>& grid, const Vec<3>& place);

/// A surface without some columns: the triangles that remain, and the two faces at which it is cut.
struct CutSurface {
  std::vector<std::array<int, 3>> triangles;  ///< of the surface's points
  std::vector<Vec<3>> face_points;            ///< body frame [m]
  std::vector<std::array<int, 3>> face_triangles;
};

/// The triangles of the result enclose the rest of the material, if those of the surface enclose the
/// material.
CutSurface cut_open(const SurfaceMesh& surface, const PolarGrid<3>& grid, const ColumnRange& removed);

/// The area of the material's section at the beginning of every column [m^2].
std::vector<double> section_areas(const SurfaceMesh& surface, const PolarGrid<3>& grid);

/// Whether the surface has pieces that enclose no material, of cavities inside of it.
bool has_closed_cavities(const SurfaceMesh& surface);

}  // namespace wheelwright
