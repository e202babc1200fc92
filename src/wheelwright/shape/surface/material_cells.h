#pragma once

#include <cstdint>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/surface/clipped_vertices.h"

namespace wheelwright {

enum class MaterialCellKind : std::uint8_t { tetrahedron, wedge, hexahedron };

/// The material of one sector as cells. Their corners are those of VTK: a hexahedron's go around its face z =
/// 0 and then around z = 1; a wedge has two triangles, the first of which runs clockwise when seen from the
/// second.
struct MaterialCells {
  std::vector<CellPoint> places;  ///< of the vertices, on the grid
  std::vector<Vec<3>> points;     ///< of the vertices, Cartesian [m], in the frame of the sector
  std::vector<ClippedVertices::Number> corners;  ///< of all cells, one after the other
  std::vector<MaterialCellKind> kinds;           ///< of the cells
};

constexpr int n_corners(MaterialCellKind kind) {
  return kind == MaterialCellKind::tetrahedron ? 4 : kind == MaterialCellKind::wedge ? 6 : 8;
}

/// The inside of material_surface() with the same arguments: cubes that are material are hexahedra, the
/// others are divided into tetrahedra and clipped.
MaterialCells material_cells(const LevelSet<3>& psi, int parts, int map_degree);

}  // namespace wheelwright
