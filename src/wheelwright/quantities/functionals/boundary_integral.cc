#include "wheelwright/quantities/functionals/boundary_integral.h"

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/curvature.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> BoundaryIntegral<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                     const State<dim>& state, const Matrix&) const {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const int degree = solver.model().degree;
  FunctionalValue<dim> value;
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

template class BoundaryIntegral<2>;
template class BoundaryIntegral<3>;

}  // namespace wheelwright
