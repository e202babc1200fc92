#include "wheelwright/quantities/functionals/mass.h"

#include "wheelwright/mechanics/state/layer_measures.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> Mass<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                         const State<dim>& state, const Matrix&) const {
  const PolarGrid<dim>& grid = solver.model().grid;
  const auto of_sectors = [&](const MaterialLaw<dim>& law) {
    return law.density().value_or(0) * grid.n_sectors;
  };
  FunctionalValue<dim> value;
  const auto counts = [&](int row) { return !part_ || part_->has_row(grid, row); };
  const std::vector<double> parts =
      layer_measures<dim>(materials_, solver.model().degree, state.domain(), counts);
  for (std::size_t layer = 0; layer < parts.size(); ++layer)
    value.of_shape += parts[layer] * of_sectors(*materials_.layers()[layer].law);
  for (const SurfacePoint<dim>& point : state.boundary()) {
    const int row = grid.cell_position(point.cell)[0];
    value.gradient_of_shape.push_back(counts(row) ? of_sectors(materials_.in_row(grid, row)) : 0);
  }
  return value;
}

template class Mass<2>;
template class Mass<3>;

}  // namespace wheelwright
