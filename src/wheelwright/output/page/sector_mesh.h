#pragma once

#include <cstdint>
#include <vector>

#include "wheelwright/output/page/shown_ground.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Points of the material of sector 0, with the data to interpolate a field there, and triangles between
/// them.
struct SectorMesh {
  std::vector<Vec<2>> points;              ///< Cartesian [m]
  std::vector<int> rows;                   ///< of the cell of every point
  std::vector<RingCellNodes<2>> nodes;     ///< of that cell
  std::vector<ShapeFunctions<2>> shapes;   ///< of the fields there, in its cell
  std::vector<std::uint32_t> triangles;    ///< corners, counter-clockwise
  std::vector<std::uint32_t> layer_edges;  ///< pairs of points: the edges between layers, of the inner one
};

/// The mesh of a shape in the plane for the fields of a model. Polygons next to refined ones also
/// have the midpoints of their sides, so that no gaps open when the mesh is deformed. Points between layers
/// of materials are there once for each of them.
SectorMesh sector_mesh(const LevelSet<2>& psi, const RollingModel<2>& model);

/// One load position: the fields at the points of a mesh in all sectors, in the order point + n_points *
/// sector; NaN where there is no material.
struct MeshPosition {
  double ground_azimuth;          ///< as in PositionFields
  std::vector<double> x, y;       ///< displacement [m], body frame
  std::vector<double> von_mises;  ///< at most the material's peak, which nodes of slivers exceed [Pa]
  std::optional<ShownGround> ground = {};
};

MeshPosition on_mesh(const SectorMesh& mesh, const PositionFields<2>& fields);

}  // namespace wheelwright
