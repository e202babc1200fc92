#include "wheelwright/quantities/functionals/boundary_integral.h"

#include "wheelwright/mechanics/state/by_radii.h"
#include "wheelwright/mechanics/state/place_in_body.h"
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
  std::vector<Vec<dim>> places;
  for (const SurfacePoint<dim>& point : state.boundary())
    places.push_back(cartesian_place<dim>(grid, degree, point.cell, point.xi));
  const auto at_places = densities(places);
  for (size_t q = 0; q < places.size(); ++q) {
    const SurfacePoint<dim>& point = state.boundary()[q];
    const auto& [n, gradient] = at_places[q];
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
    std::vector<Vec<dim>> places;
    for (const auto& point : cut.boundary)
      places.push_back(cartesian_place<dim>(domain.grid, map_degree, cut.cell, point.xi));
    const auto at_places = densities(places);
    for (size_t q = 0; q < places.size(); ++q) {
      const auto& point = cut.boundary[q];
      const ShapeFunctions<dim> shape(map_degree, point.xi);
      sum += point.weight * map_surface<dim>(map.jacobian(shape), point.normal).scale * at_places[q].value;
    }
  }
  return sum;
}

template <int dim>
std::vector<typename BoundaryIntegral<dim>::Density> BoundaryIntegral<dim>::densities(
    std::span<const Vec<dim>> points) const {
  std::vector<Density> result;
  for (const Vec<dim>& x : points) result.push_back(density(x));
  return result;
}

template class BoundaryIntegral<2>;
template class BoundaryIntegral<3>;

}  // namespace wheelwright
