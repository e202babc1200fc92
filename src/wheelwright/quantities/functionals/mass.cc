#include "wheelwright/quantities/functionals/mass.h"

#include "wheelwright/mechanics/state/by_radii.h"
#include "wheelwright/mechanics/state/layer_measures.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> Mass<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                         const State<dim>& state, const Matrix&) const {
  const PolarGrid<dim>& grid = solver.model().grid;
  const auto of_sectors = [&](const MaterialLaw<dim>& law) {
    return law.density().value_or(0) * grid.n_sectors;
  };
  const auto counts = [&](int row) { return !part_ || part_->has_row(grid, row); };
  const auto mass = [&](const CutDomain<dim>& domain) {
    const std::vector<double> parts = layer_measures<dim>(materials_, solver.model().degree, domain, counts);
    double sum = 0;
    for (std::size_t layer = 0; layer < parts.size(); ++layer)
      sum += parts[layer] * of_sectors(*materials_.layers()[layer].law);
    return sum;
  };
  FunctionalValue<dim> value{.of_shape = mass(state.domain()),
                             .by_radius_of_shape = by_radii<dim>(solver.model(), state.domain(), mass)};
  for (const SurfacePoint<dim>& point : state.boundary()) {
    const int row = grid.cell_position(point.cell)[0];
    value.gradient_of_shape.push_back(counts(row) ? of_sectors(materials_.in_row(grid, row)) : 0);
  }
  return value;
}

template class Mass<2>;
template class Mass<3>;

}  // namespace wheelwright
