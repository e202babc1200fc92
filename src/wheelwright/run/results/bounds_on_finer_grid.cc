#include "wheelwright/run/results/bounds_on_finer_grid.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/quantities/analysis/discretization_error.h"

namespace wheelwright {
namespace {

using BoundStates = Expected<std::vector<BoundState>, std::string>;

/// The value of a bound; or why it is not known.
KnownNumber value_of(const SummarizedBound& bound, const BoundStates& states) {
  if (!states) return states.failure();
  const auto found = std::ranges::find_if(*states, [&](const BoundState& state) {
    return state.name == bound.name && state.relation == bound.relation;
  });
  if (found == states->end() || !std::isfinite(found->value)) return std::string("it has no value there");
  return found->value;
}

/// Single positions and extremes converge alike: at one of them the error may be small by chance.
template <int dim>
Converges convergence(const std::string& name, const std::vector<ShapeFunction<dim>>& functions) {
  const auto function = std::ranges::find(functions, name, &ShapeFunction<dim>::name);
  const bool is_integral =
      function != functions.end() && !function->quantity->is_maximum && function->over == Over::mean;
  return is_integral ? Converges::as_an_integral : Converges::as_an_extreme;
}

FinerVerdict verdict(const SummarizedBound& bound, double value, double error) {
  const double tolerance = feasible_violation * (bound.bound == 0 ? 1 : std::abs(bound.bound));
  const double excess = beyond(bound, value);
  return excess + error <= tolerance  ? FinerVerdict::kept
         : excess - error > tolerance ? FinerVerdict::broken
                                      : FinerVerdict::within_error;
}

}  // namespace

template <int dim>
void add_finer_values(const std::vector<ShapeFunction<dim>>& functions, const BoundStates& here,
                      const BoundStates& finer, double refinement, std::vector<SummarizedBound>& bounds) {
  for (SummarizedBound& bound : bounds) {
    const KnownNumber value = value_of(bound, here), on_finer = value_of(bound, finer);
    if (!value || !on_finer) {
      bound.finer = Expected<BoundOnFinerGrid, std::string>((value ? on_finer : value).failure());
      continue;
    }
    const double error =
        error_on_finer_grid(*value, *on_finer, refinement, convergence(bound.name, functions));
    bound.finer = BoundOnFinerGrid{*on_finer, error, verdict(bound, *on_finer, error)};
  }
}

template decltype(add_finer_values<2>) add_finer_values<2>;
template decltype(add_finer_values<3>) add_finer_values<3>;

}  // namespace wheelwright
