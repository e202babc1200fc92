#include "wheelwright/mechanics/rolling/moving_boundary.h"

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// The mirror image of the points of a cell.
template <int dim, class Point>
std::vector<Point> mirrored(std::vector<Point> points) {
  for (Point& q : points) {
    q.xi[1] = 1 - q.xi[1];
    if constexpr (requires { q.normal; }) q.normal = mirror_image<dim>(q.normal);
  }
  return points;
}

}  // namespace

template <int dim>
std::vector<CellBoundary<dim>> cells_of(const CutDomain<dim>& domain, const LoadPositions& positions,
                                        const CutCell<dim>& cut) {
  if (!positions.stand_for_images()) return {{cut.cell, cut.boundary, cut.material, cut.edges}};
  const int image = mirror_image(domain.grid, cut.cell);
  if (image < cut.cell) return {};
  std::vector<CellBoundary<dim>> cells{
      {cut.cell, cut.boundary, cut.material, cut.edges},
      {image, mirrored<dim>(cut.boundary), mirrored<dim>(cut.material), mirrored<dim>(cut.edges)}};
  if (image == cut.cell)
    for (auto& cell : cells) {
      for (auto& q : cell.rule) q.weight /= 2;
      for (auto& q : cell.edges) q.weight /= 2;
    }
  return cells;
}

template <int dim>
std::vector<SurfacePoint<dim>> moving_boundary_points(const CutDomain<dim>& domain, int degree,
                                                      const LoadPositions& positions) {
  const PolarGrid<dim>& grid = domain.grid;
  std::vector<SurfacePoint<dim>> points;
  for (const CutCell<dim>& cut : domain.cut)
    for (const auto& [cell, rule, material, edges] : cells_of(domain, positions, cut)) {
      const auto place = grid.cell_position(cell);
      const CellMap<dim> map(grid, degree, place);
      for (const auto& q : rule) {
        const auto surface = map_surface<dim>(map.jacobian(ShapeFunctions<dim>(degree, q.xi)), q.normal);
        points.push_back({cell, q.xi, rotated<dim>(surface.normal, place[1] * grid.column_angle()),
                          q.weight * surface.scale});
      }
    }
  return points;
}

ByFunction joined(size_t n_functions, const std::vector<ByFunction>& of_cells) {
  ByFunction all(n_functions);
  for (const ByFunction& of_cell : of_cells)
    for (size_t f = 0; f < of_cell.size(); ++f)
      all[f].insert(all[f].end(), of_cell[f].begin(), of_cell[f].end());
  return all;
}

template decltype(cells_of<2>) cells_of<2>;
template decltype(cells_of<3>) cells_of<3>;
template decltype(moving_boundary_points<2>) moving_boundary_points<2>;
template decltype(moving_boundary_points<3>) moving_boundary_points<3>;

}  // namespace wheelwright
