#include "wheelwright/run/results/summarized_run.h"

#include "wheelwright/case/derived.h"
#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/single_load.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/run/results/bounded_peaks.h"
#include "wheelwright/run/results/given_wheel.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/results/remarks.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/run/study/bounded_functions.h"

namespace wheelwright {
namespace {

template <int dim>
std::vector<SummarizedBound> summarized_bounds(const OptimizationState<dim>& state, const Wheel& wheel) {
  std::vector<SummarizedBound> result;
  for (const BoundState& b : bound_states(state.evaluation, state.memory.multipliers))
    result.push_back({.name = b.name,
                      .value = b.value,
                      .bound = b.bound,
                      .relation = b.relation,
                      .multiplier = b.multiplier,
                      .is_kept = b.is_kept(),
                      .kept_within = b.kept_within(),
                      .unit = unit<dim>(b.unit),
                      .shown = shown_unit(b.unit, dim, wheel.width)});
  return result;
}

template <int dim>
std::vector<ChosenRadius> chosen_radii(const Study<dim>& study, const Study<dim>& given) {
  std::vector<ChosenRadius> result;
  const std::vector<DesignRadius> before = design_radii(given.source), after = design_radii(study.source);
  for (std::size_t k = 0; k < after.size(); ++k)
    result.push_back({after[k].name, before[k].radius, after[k].radius, after[k].least, after[k].most});
  return result;
}

KnownNumber known(const Expected<double>& value) {
  if (value) return *value;
  return to_string(value.failure());
}

}  // namespace

template <int dim>
RunSummary<dim> summarized_run(const Study<dim>& study, const Study<dim>& given,
                               const InitialShape<dim>& start, const Expected<double>& objective,
                               DescribedWheel<dim> before, const OptimizationState<dim>& last,
                               DescribedWheel<dim> after) {
  auto worse = remarks(study.source, before, after);
  return {.title = run_title(study.source),
          .before = {0, known(objective), std::move(before)},
          .after = {last.iteration, last.evaluation.function("objective").value, std::move(after)},
          .bounds = summarized_bounds(last, study.source.wheel),
          .minimized = minimizes_weighted_sum(study.source) ? "" : name(minimized_quantity(study.source)),
          .sum = sum_over_load_cases(study.source),
          .objective_kind = kind(study.source.objective.minimize),
          .objective = shown_unit(study.source.objective.minimize, study.source.wheel),
          .remarks = std::move(worse),
          .bounded_peaks = bounded_peaks(study.source),
          .radii = chosen_radii(study, given),
          .made = made_wheel<dim>(study.source, last.shape),
          .changed_start = changed_start(given, start)};
}

template decltype(summarized_run<2>) summarized_run<2>;
template decltype(summarized_run<3>) summarized_run<3>;

}  // namespace wheelwright
