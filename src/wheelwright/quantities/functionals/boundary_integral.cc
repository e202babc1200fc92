#include "wheelwright/quantities/functionals/boundary_integral.h"

#include "wheelwright/mechanics/state/by_radii.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/curvature.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> BoundaryIntegral<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                     const State<dim>& state, const Matrix&) const {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const int degree = solver.model().degree;
  FunctionalValue<dim> value{.by_radius_of_shape = by_radii<dim>(
                                 solver.model(), state.domain(),
                                 [&](const CutDomain<dim>& domain) { return integral(domain, degree); })};
  for (const SurfacePoint<dim>& point : state.boundary()) {
    const auto place = grid.cell_position(point.cell);
    const CellMap<dim> map(grid, degree, place);
    const Vec<dim> x =
        rotated<dim>(map.position(ShapeFunctions<dim>(degree, point.xi)), place[1] * grid.column_angle());
    const auto [n, gradient] = density(x);
    value.of_shape += point.weight * n;
    value.gradient_of_shape.push_back(mean_curvature<dim>(psi, degree, point.cell, point.xi) * n +
                                      dot<dim>(gradient, point.normal));
  }
  return value;
}

/// From the quadrature of the cut cells.
template <int dim>
double BoundaryIntegral<dim>::integral(const CutDomain<dim>& domain, int map_degree) const {
  double sum = 0;
  for (const CutCell<dim>& cut : domain.cut) {
    const auto place = domain.grid.cell_position(cut.cell);
    const CellMap<dim> map(domain.grid, map_degree, place);
    for (const auto& point : cut.boundary) {
      const ShapeFunctions<dim> shape(map_degree, point.xi);
      const Vec<dim> x = rotated<dim>(map.position(shape), place[1] * domain.grid.column_angle());
      sum += point.weight * map_surface<dim>(map.jacobian(shape), point.normal).scale * density(x).value;
    }
  }
  return sum;
}

template class BoundaryIntegral<2>;
template class BoundaryIntegral<3>;

}  // namespace wheelwright
