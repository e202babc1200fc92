#include "wheelwright/run/study/nucleated_shape.h"

#include <algorithm>
#include <numbers>

#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

HoleRules hole_rules(const Study<2>& study) {
  constexpr double cells_per_radius = 1.5, cells_per_wall = 2, wider = 1.02, most_share = 0.03;
  const PolarGrid<2>& grid = study.grid();
  const double h = grid.resolution();
  const FeatureSize& minimum = study.evolution.features;
  return {.radius = std::max(cells_per_radius * h, 0.5 * wider * minimum.gap),
          .wall = std::max(cells_per_wall * h, minimum.wall),
          .range = hole_range(grid, study.evolution.bands),
          .max_area = most_share * sector_measure<2>(grid),
          .must_pay = true};
}

Expected<std::vector<Circle>> holes_that_pay(const Study<2>& study,
                                             const ShapeOptimizer<2>::Evaluate& evaluate,
                                             const Evolver<2>& evolver, const OptimizationState<2>& state) {
  const auto evaluated = evaluate(state.shape, nullptr);
  if (!evaluated) return evaluated.failure();
  std::vector<const State<2>*> states{evaluated->state.get()};
  for (const auto& other : evaluated->others) states.push_back(other.get());
  const RollingModel<2>& model = study.model();
  const auto points = middles_of_full_cells(states.front()->domain(), model.grid.cells[0] - model.tread.rows);
  const HoleRules rules = hole_rules(study);
  const auto derivatives = topological_derivatives<2>(*study.solver, study.load_cases, study.functions,
                                                      state.shape, states, points, rules.radius);
  if (!derivatives) return derivatives.failure();
  return paying_holes(study.optimizer, evolver, state, points, *derivatives, rules);
}

}  // namespace

Expected<std::optional<NucleatedShape>> nucleated_shape(const Study<2>& study,
                                                        const ShapeOptimizer<2>::Evaluate& evaluate,
                                                        const Evolver<2>& evolver,
                                                        const OptimizationState<2>& state) {
  const auto holes = holes_that_pay(study, evaluate, evolver, state);
  if (!holes) return holes.failure();
  if (holes->empty()) return std::optional<NucleatedShape>();
  NucleatedShape made{evolver.keep_bands(with_holes(state.shape, *holes)), nucleation_text(*holes)};
  if (study.optimizer.measure_control == MeasureControl::exact && !is_approaching(study.optimizer, state)) {
    double edges = 0;
    for (const auto& point : state.evaluation.boundary) edges += point.weight;
    for (const Circle& hole : *holes) edges += 2 * std::numbers::pi * hole.hole_radius;
    auto shifted = evolver.with_measure(made.shape, state.measure, edges);
    if (!shifted) return shifted.failure();
    made.shape = std::move(shifted->shape);
  }
  return std::optional(std::move(made));
}

}  // namespace wheelwright
