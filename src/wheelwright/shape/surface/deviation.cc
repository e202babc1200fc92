#include "wheelwright/shape/surface/deviation.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// The middle of a triangle in units of cells, from the start of sector 0.
Vec<3> middle(const SurfaceMesh& mesh, const std::array<int, 3>& triangle, int columns) {
  std::array<Vec<3>, 3> corners;
  double last = 0;
  for (int k = 0; k < 3; ++k) {
    const CellPoint& place = mesh.places[triangle[k] % mesh.sector_points()];
    for (int d = 0; d < 3; ++d) corners[k][d] = place.cell[d] + place.xi[d];
    last = std::max(last, corners[k][1]);
  }
  Vec<3> sum{};
  for (Vec<3>& corner : corners) {
    if (last - corner[1] > 0.5 * columns) corner[1] += columns;  // at the first azimuth of the next sector
    sum += corner / 3;
  }
  return sum;
}

double distance(const LevelSet<3>& psi, const CellPoint& place, int map_degree) {
  const PolarGrid<3>& grid = psi.lattice.grid();
  const auto nodal = psi.cell_values(grid.cell_index(place.cell));
  const ShapeFunctions<3> shape(psi.lattice.degree(), place.xi);
  double value = 0;
  Vec<3> reference{};
  for (std::size_t a = 0; a < nodal.size(); ++a) {
    value += shape.value[a] * nodal[a];
    reference += nodal[a] * shape.gradient[a];
  }
  const Mat<3> jacobian =
      CellMap<3>(grid, map_degree, place.cell).jacobian(ShapeFunctions<3>(map_degree, place.xi));
  return std::abs(value) / norm<3>(transpose_times<3>(inverse<3>(jacobian), reference));
}

}  // namespace

SurfaceDeviation deviation(const SurfaceMesh& mesh, const LevelSet<3>& psi, int map_degree) {
  const PolarGrid<3>& grid = psi.lattice.grid();
  SurfaceDeviation largest{0, {}};
  for (std::size_t t = 0; t < mesh.triangles.size() / mesh.n_sectors; ++t) {
    if (mesh.parts[t] != SurfacePart::hole) continue;
    const Vec<3> u = middle(mesh, mesh.triangles[t], grid.columns());
    CellPoint place;
    for (int d = 0; d < 3; ++d) {
      place.cell[d] = std::min(static_cast<int>(u[d]), grid.cells[d] - 1);
      place.xi[d] = u[d] - place.cell[d];
    }
    const double found = distance(psi, place, map_degree);
    if (!(found > largest.distance)) continue;
    largest.distance = found;
    largest.place = grid.polar_point(place.cell, place.xi);
  }
  return largest;
}

}  // namespace wheelwright
