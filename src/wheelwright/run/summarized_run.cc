#include "wheelwright/run/summarized_run.h"

#include <fmt/format.h>

#include "wheelwright/base/quantity.h"
#include "wheelwright/optimize/constraints.h"
#include "wheelwright/run/run_title.h"

namespace wheelwright {
namespace {

template <int dim>
std::string minimized_text(Quantity quantity) {
  if (quantity == Quantity::objective) return {};
  return fmt::format("{} [{}]", name(quantity), unit<dim>(kind(quantity)));
}

template <int dim>
std::vector<SummarizedBound> summarized_bounds(const OptimizationState<dim>& state) {
  std::vector<SummarizedBound> result;
  for (const BoundState& b : bound_states(state.evaluation, state.memory.multipliers))
    result.push_back({b.name, b.value, b.bound, b.relation, b.multiplier, b.is_kept()});
  return result;
}

}  // namespace

template <int dim>
RunSummary<dim> summarized_run(const Case& c, const InitialShape<dim>& initial, DescribedWheel<dim> before,
                               const OptimizationState<dim>& last, DescribedWheel<dim> after) {
  return {.title = run_title(c),
          .before = {0, initial.objective, std::move(before)},
          .after = {last.iteration, last.evaluation.function("objective").value, std::move(after)},
          .bounds = summarized_bounds(last),
          .minimized = minimized_text<dim>(c.objective.minimize)};
}

template RunSummary<2> summarized_run(const Case&, const InitialShape<2>&, DescribedWheel<2>,
                                      const OptimizationState<2>&, DescribedWheel<2>);
template RunSummary<3> summarized_run(const Case&, const InitialShape<3>&, DescribedWheel<3>,
                                      const OptimizationState<3>&, DescribedWheel<3>);

}  // namespace wheelwright
