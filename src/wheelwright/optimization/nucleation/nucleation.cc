#include "wheelwright/optimization/nucleation/nucleation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {

template <int dim>
typename Nucleation<dim>::Before before_nucleation(const OptimizerOptions& options,
                                                   const OptimizationState<dim>& state) {
  return {.shape = state.shape,
          .objective = state.evaluation.function(options.objective).value,
          .violation = largest_violation(bound_constraints(state.evaluation)),
          .is_comparable = !is_approaching(options, state)};
}

template <int dim>
bool has_paid(const OptimizerOptions& options, const typename Nucleation<dim>::Before& before,
              const Evaluation<dim>& now) {
  if (!before.is_comparable) return true;
  const double violation = largest_violation(bound_constraints(now));
  if (violation > std::max(feasible_violation, before.violation)) return false;
  const double minimum = (options.accepted_increase + options.tolerance) * std::abs(before.objective);
  return now.function(options.objective).value < before.objective - minimum;
}

template <int dim>
std::vector<double> lagrangian_weights(const OptimizerOptions& options, const OptimizationState<dim>& state) {
  const auto& functions = state.evaluation.functions;
  std::vector<double> weights(functions.size(), 0.0);
  for (size_t f = 0; f < functions.size(); ++f)
    if (functions[f].name == options.objective) weights[f] = 1;
  const auto constraints = bound_constraints(state.evaluation);
  const bool is_known = state.memory.multipliers.size() == constraints.size();
  const double unknown = std::abs(state.evaluation.function(options.objective).value);
  for (size_t i = 0; i < constraints.size(); ++i)
    weights[constraints[i].function] +=
        (is_known ? state.memory.multipliers[i] : unknown) * constraints[i].sign / constraints[i].scale;
  return weights;
}

template <int dim>
std::optional<double> gain_at_edges(const OptimizerOptions& options, const Evolver<dim>& evolver,
                                    const OptimizationState<dim>& state) {
  const auto weights = lagrangian_weights(options, state);
  const auto& [functions, boundary] = std::tie(state.evaluation.functions, state.evaluation.boundary);
  const auto held = evolver.at_bands(boundary);
  double sum = 0, length = 0;
  for (size_t q = 0; q < boundary.size(); ++q) {
    if (held[q]) continue;
    for (size_t f = 0; f < functions.size(); ++f)
      sum -= weights[f] * boundary[q].weight * functions[f].gradient[q];
    length += boundary[q].weight;
  }
  return length > 0 ? std::optional(sum / length) : std::nullopt;
}

template <int dim>
std::vector<RoundHole<dim>> paying_holes(const OptimizerOptions& options, const Evolver<dim>& evolver,
                                         const OptimizationState<dim>& state,
                                         std::span<const MaterialPoint<dim>> points,
                                         const std::vector<std::vector<double>>& derivatives,
                                         HoleRules rules) {
  const auto weights = lagrangian_weights(options, state);
  const auto gain = gain_at_edges(options, evolver, state);
  const bool is_held = options.measure_control != MeasureControl::free;
  const double excess = state.measure - state.target_measure;
  rules.must_pay = gain || !is_held;
  if (is_held && !gain) {
    if (excess <= measure_tolerance * state.target_measure) return {};
    rules.max_measure = std::min(rules.max_measure, excess);
  }
  std::vector<double> costs(points.size(), is_held && gain ? -*gain : 0.0);
  for (size_t f = 0; f < derivatives.size(); ++f)
    for (size_t i = 0; i < costs.size(); ++i) costs[i] += weights[f] * derivatives[f][i];
  return best_places<dim>(state.shape, {points, costs}, rules);
}

template <int dim>
std::string nucleation_text(std::span<const RoundHole<dim>> holes) {
  std::string text = fmt::format("nucleation of {} {} per sector, of radius {:.4g} mm, at", holes.size(),
                                 holes.size() == 1 ? "hole" : "holes", holes.front().hole_radius * 1e3);
  for (const auto& hole : holes)
    text += fmt::format("{} {}", &hole == holes.data() ? "" : " and", place_text<dim>(centre(hole)));
  return text;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                  \
  template decltype(before_nucleation<dim>) before_nucleation<dim>;   \
  template decltype(has_paid<dim>) has_paid<dim>;                     \
  template decltype(lagrangian_weights<dim>) lagrangian_weights<dim>; \
  template decltype(gain_at_edges<dim>) gain_at_edges<dim>;           \
  template decltype(paying_holes<dim>) paying_holes<dim>;             \
  template decltype(nucleation_text<dim>) nucleation_text<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
