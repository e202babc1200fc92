#include "wheelwright/run/study/nucleated_shape.h"

#include <algorithm>

#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/ball.h"

namespace wheelwright {
namespace {

template <int dim>
HoleRules hole_rules(const Study<dim>& study) {
  constexpr double cells_per_radius = 1.5, cells_per_wall = 2, wider = 1.02, most_share = 0.03;
  const PolarGrid<dim>& grid = study.grid();
  const double h = grid.resolution();
  const FeatureSize& minimum = study.evolution.features;
  return {.radius = std::max(cells_per_radius * h, 0.5 * wider * minimum.gap),
          .wall = std::max(cells_per_wall * h, minimum.wall),
          .range = hole_range(grid, study.evolution.bands),
          .max_measure = most_share * sector_measure<dim>(grid),
          .must_pay = true};
}

template <int dim>
Expected<std::vector<RoundHole<dim>>> holes_that_pay(const Study<dim>& study,
                                                     const typename ShapeOptimizer<dim>::Evaluate& evaluate,
                                                     const Evolver<dim>& evolver,
                                                     const OptimizationState<dim>& state) {
  const auto evaluated = evaluate(state.shape, nullptr);
  if (!evaluated) return evaluated.failure();
  std::vector<const State<dim>*> states{evaluated->state.get()};
  for (const auto& other : evaluated->others) states.push_back(other.get());
  const RollingModel<dim>& model = study.model();
  const auto points = middles_of_full_cells(states.front()->domain(), model.grid.cells[0] - model.tread.rows);
  const HoleRules rules = hole_rules(study);
  const auto derivatives = topological_derivatives<dim>(*study.solver, study.load_cases, study.functions,
                                                        state.shape, states, points, rules.radius);
  if (!derivatives) return derivatives.failure();
  return paying_holes<dim>(study.optimizer, evolver, state, points, *derivatives, rules);
}

}  // namespace

template <int dim>
Expected<std::optional<NucleatedShape<dim>>> nucleated_shape(
    const Study<dim>& study, const typename ShapeOptimizer<dim>::Evaluate& evaluate,
    const Evolver<dim>& evolver, const OptimizationState<dim>& state) {
  const auto holes = holes_that_pay(study, evaluate, evolver, state);
  if (!holes) return holes.failure();
  if (holes->empty()) return std::optional<NucleatedShape<dim>>();
  NucleatedShape<dim> made{evolver.keep_bands(with_holes<dim>(state.shape, *holes)),
                           nucleation_text<dim>(*holes)};
  if (study.optimizer.measure_control == MeasureControl::exact && !is_approaching(study.optimizer, state)) {
    double edges = 0;
    for (const auto& point : state.evaluation.boundary) edges += point.weight;
    for (const auto& hole : *holes) edges += sphere_measure<dim>(hole.hole_radius);
    auto shifted = evolver.with_measure(made.shape, state.measure, edges);
    if (!shifted) return shifted.failure();
    made.shape = std::move(shifted->shape);
  }
  return std::optional(std::move(made));
}

template decltype(nucleated_shape<2>) nucleated_shape<2>;
template decltype(nucleated_shape<3>) nucleated_shape<3>;

}  // namespace wheelwright
