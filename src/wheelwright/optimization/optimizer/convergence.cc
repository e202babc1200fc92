#include "wheelwright/optimization/optimizer/convergence.h"

#include <cmath>
#include <optional>

#include "wheelwright/optimization/optimizer/constraints.h"

namespace wheelwright {
namespace {

constexpr std::size_t shapes_of_descent = 10;
constexpr int trials_without_gain = 6;

}  // namespace

int trials_since_gain(std::span<const AcceptedShape> history, double tolerance) {
  std::optional<double> best;
  int trials = 0;
  for (const AcceptedShape& shape : history) {
    const bool keeps_bounds = shape.violation <= feasible_violation;
    if (keeps_bounds && (!best || shape.objective < *best - tolerance * std::abs(*best))) {
      best = shape.objective;
      trials = 0;
    }
    trials += shape.trials;
  }
  return trials;
}

bool is_slow(const OptimizerOptions& options, double tolerance, std::span<const AcceptedShape> history,
             bool has_bounds) {
  if (tolerance <= 0 || history.size() <= shapes_of_descent) return false;
  const double before = history[history.size() - 1 - shapes_of_descent].objective;
  double fall = before - history.back().objective;
  // The paper's rule lets the measure drift, and the objective rises with it; violated bounds have the same
  // effect.
  if (options.measure_control == MeasureControl::proportional || has_bounds) fall = std::abs(fall);
  return fall < tolerance * std::abs(before);
}

template <int dim>
bool has_converged(const OptimizerOptions& options, const OptimizationState<dim>& state, int rejected) {
  const auto bounds = bound_constraints(state.evaluation);
  if (options.tolerance <= 0 || largest_violation(bounds) > feasible_violation) return false;
  if (options.method == Method::descent)
    return is_slow(options, options.tolerance, state.history, !bounds.empty());
  return !is_approaching(options, state) &&
         trials_since_gain(state.history, options.tolerance) + rejected >= trials_without_gain;
}

template <int dim>
bool predicts_gain(const OptimizerOptions& options, const OptimizationState<dim>& state, double decrease) {
  return decrease > options.tolerance * std::abs(state.evaluation.function(options.objective).value);
}

template <int dim>
bool has_lost_its_model(const OptimizerOptions& options, const OptimizationState<dim>& state) {
  constexpr double small = 0.1;
  if (options.method == Method::descent || options.tolerance <= 0 || state.step >= small * options.step ||
      bound_constraints(state.evaluation).empty())
    return false;
  const AcceptedShape& first = state.history.front();
  return first.violation > feasible_violation ||
         state.history.back().objective < first.objective - options.tolerance * std::abs(first.objective);
}

template decltype(has_lost_its_model<2>) has_lost_its_model<2>;
template decltype(has_lost_its_model<3>) has_lost_its_model<3>;

template decltype(has_converged<2>) has_converged<2>;
template decltype(predicts_gain<2>) predicts_gain<2>;
template decltype(has_converged<3>) has_converged<3>;
template decltype(predicts_gain<3>) predicts_gain<3>;

}  // namespace wheelwright
