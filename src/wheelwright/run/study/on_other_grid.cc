#include "wheelwright/run/study/on_other_grid.h"

#include "wheelwright/shape/evolution/regrid.h"
#include "wheelwright/shape/geometry/components.h"
#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {
namespace {

/// Changes of the holes of a shape by its transfer to another grid.
template <int dim>
std::vector<ShapeEvent<dim>> changes_by_grid(const LevelSet<dim>& before, const LevelSet<dim>& after) {
  PolarGrid<dim> fine = after.lattice.grid();
  for (int& cells : fine.cells) cells *= component_samples;
  return topology_changes(components(values_on(before, Lattice<dim>(fine, 1)), 1), components(after));
}

}  // namespace

template <int dim>
Expected<OnOtherGrid<dim>> on_other_grid(const OptimizationState<dim>& state, const Lattice<dim>& lattice,
                                         const Evolver<dim>& evolver) {
  const LevelSet<dim> there = evolver.keep_bands(regrid(state.shape, lattice));
  double edges = 0;
  for (const auto& point : state.evaluation.boundary) edges += point.weight;
  auto with_measure = evolver.with_measure(there, state.measure, edges);
  if (!with_measure) return with_measure.failure();
  OnOtherGrid<dim> moved{.state = state, .events = changes_by_grid(state.shape, with_measure->shape)};
  moved.state.shape = std::move(with_measure->shape);
  moved.state.measure = with_measure->measure;
  return moved;
}

template decltype(on_other_grid<2>) on_other_grid<2>;
template decltype(on_other_grid<3>) on_other_grid<3>;

}  // namespace wheelwright
