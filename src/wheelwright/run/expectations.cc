#include "wheelwright/run/expectations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/analysis/strain_peaks.h"

namespace wheelwright {
namespace {

template <class NamedValue>
std::optional<double> named_value(const std::vector<NamedValue>& values, std::string_view name) {
  const auto found = std::ranges::find(values, name, &NamedValue::name);
  return found == values.end() ? std::nullopt : std::optional(found->value);
}

template <int dim>
std::optional<double> value_of(Quantity quantity, const StateSolver<dim>& solver,
                               const OptimizationState<dim>& state, const State<dim>* solution) {
  const Evaluation<dim>& evaluation = state.evaluation;
  if (quantity == Quantity::objective) return evaluation.function("objective").value;
  if (quantity == Quantity::volume_fraction) return volume_fraction(solver.model().grid, state.measure);
  if (quantity == Quantity::peak_von_mises)
    return solution ? std::optional(std::ranges::max(strain_peaks(solver, *solution).von_mises)) : std::nullopt;
  if (const auto criterion = named_value(evaluation.terms, name(quantity))) return criterion;
  return named_value(evaluation.measures, name(quantity));
}

}  // namespace

bool Finding::met() const {
  const double margin = expectation.margin * expectation.value;
  return found && std::abs(*found - expectation.value) <= margin;
}

std::string Finding::text() const {
  const std::string shape =
      expectation.iteration ? fmt::format("shape {}", *expectation.iteration) : "the last shape";
  const std::string quantity = fmt::format("{} of {}", name(expectation.quantity), shape);
  const std::string expected =
      fmt::format("{:.6g} within {:.3g} %", expectation.value, 100 * expectation.margin);
  if (!found) return fmt::format("{}: not computed, expected {}", quantity, expected);
  return fmt::format("{}: {:.6g}, {} {}", quantity, *found, met() ? "as expected," : "expected", expected);
}

template <int dim>
ExpectationWatch<dim>::ExpectationWatch(std::vector<Expectation> expectations,
                                        const std::optional<Checkpoint<dim>>& resumed)
    : expectations_(std::move(expectations)) {
  if (resumed) found_ = resumed->found;
}

template <int dim>
void ExpectationWatch<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto* done = std::get_if<TrialDone<dim>>(&event);
  if (!done || done->trial.verdict != Verdict::accepted || !done->trial.solution) return;
  const int iteration = done->state.iteration;
  std::erase_if(found_, [&](const FoundQuantity& f) { return f.iteration == iteration; });
  for (auto& found : found_quantities(expectations_, *run.study.solver, done->state, *done->trial.solution))
    found_.push_back(std::move(found));
}

template <int dim>
void ExpectationWatch<dim>::add_to(Checkpoint<dim>& checkpoint) {
  checkpoint.found = found_;
}

template <int dim>
std::vector<FoundQuantity> found_quantities(const std::vector<Expectation>& expectations,
                                            const StateSolver<dim>& solver,
                                            const OptimizationState<dim>& state, const State<dim>& solution) {
  std::vector<FoundQuantity> result;
  for (const Expectation& expectation : expectations)
    if (expectation.iteration == state.iteration)
      if (const auto value = value_of(expectation.quantity, solver, state, &solution))
        result.push_back({state.iteration, std::string(name(expectation.quantity)), *value});
  return result;
}

template <int dim>
std::vector<Finding> findings(const std::vector<Expectation>& expectations,
                              const std::vector<FoundQuantity>& found, const StateSolver<dim>& solver,
                              const OptimizationState<dim>& last, const State<dim>* solution) {
  std::vector<Finding> result;
  for (const Expectation& expectation : expectations) {
    if (!expectation.iteration) {
      result.push_back({expectation, value_of(expectation.quantity, solver, last, solution)});
      continue;
    }
    const auto noted = std::ranges::find_if(found, [&](const FoundQuantity& f) {
      return expectation.iteration == f.iteration && name(expectation.quantity) == f.quantity;
    });
    result.push_back({expectation, noted == found.end() ? std::nullopt : std::optional(noted->value)});
  }
  return result;
}

bool need_a_solution(const std::vector<Expectation>& expectations) {
  return std::ranges::any_of(expectations,
                             [](const Expectation& e) { return e.quantity == Quantity::peak_von_mises; });
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                         \
  template class ExpectationWatch<dim>;                                                                      \
  template std::vector<FoundQuantity> found_quantities(const std::vector<Expectation>&,                      \
                                                       const StateSolver<dim>&,                              \
                                                       const OptimizationState<dim>&, const State<dim>&);    \
  template std::vector<Finding> findings(const std::vector<Expectation>&, const std::vector<FoundQuantity>&, \
                                         const StateSolver<dim>&, const OptimizationState<dim>&,             \
                                         const State<dim>*);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
