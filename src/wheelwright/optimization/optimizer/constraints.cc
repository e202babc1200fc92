#include "wheelwright/optimization/optimizer/constraints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheelwright {

template <int dim>
std::vector<BoundConstraint> bound_constraints(const Evaluation<dim>& evaluation) {
  std::vector<BoundConstraint> result;
  for (size_t k = 0; k < evaluation.functions.size(); ++k) {
    const FunctionValue& f = evaluation.functions[k];
    const bool is_equality = f.bounds.lower == f.bounds.upper;
    const auto add = [&](double sign, double bound) {
      const double scale = bound == 0 ? 1 : std::abs(bound);
      result.push_back({static_cast<int>(k), sign, scale, sign * (f.value - bound) / scale, is_equality});
    };
    if (std::isfinite(f.bounds.lower) && !is_equality) add(-1, f.bounds.lower);
    if (std::isfinite(f.bounds.upper)) add(1, f.bounds.upper);
  }
  return result;
}

double merit(double objective, const std::vector<BoundConstraint>& constraints,
             const std::vector<double>& penalties) {
  double sum = objective;
  for (size_t i = 0; i < constraints.size(); ++i) sum += penalties[i] * constraints[i].violation();
  return sum;
}

double largest_violation(const std::vector<BoundConstraint>& constraints) {
  double largest = 0;
  for (const auto& constraint : constraints) largest = std::max(largest, constraint.violation());
  return largest;
}

double BoundState::kept_within() const {
  constexpr double rounding = 1e-6;
  return is_kept() && bound != 0 && violation > rounding ? feasible_violation : 0;
}

template <int dim>
std::vector<BoundState> bound_states(const Evaluation<dim>& evaluation,
                                     const std::vector<double>& multipliers) {
  const auto constraints = bound_constraints(evaluation);
  const bool is_known = multipliers.size() == constraints.size();
  std::vector<BoundState> states;
  for (size_t i = 0; i < constraints.size(); ++i) {
    const BoundConstraint& c = constraints[i];
    const FunctionValue& f = evaluation.functions[c.function];
    states.push_back(
        {.name = f.name,
         .value = f.value,
         .bound = c.sign > 0 ? f.bounds.upper : f.bounds.lower,
         .relation = c.is_equality ? '='
                     : c.sign > 0  ? '<'
                                   : '>',
         .multiplier = is_known ? multipliers[i] / c.scale : std::numeric_limits<double>::quiet_NaN(),
         .violation = c.violation(),
         .unit = f.unit});
  }
  return states;
}

template decltype(bound_states<2>) bound_states<2>;
template decltype(bound_states<3>) bound_states<3>;
template decltype(bound_constraints<2>) bound_constraints<2>;
template decltype(bound_constraints<3>) bound_constraints<3>;

}  // namespace wheelwright
