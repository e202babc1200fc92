#include "wheelwright/run/expectations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/analysis/stress_peak.h"

namespace wheelwright {
namespace {

template <class NamedValue>
std::optional<double> named_value(const std::vector<NamedValue>& values, std::string_view name) {
  const auto found = std::ranges::find(values, name, &NamedValue::name);
  return found == values.end() ? std::nullopt : std::optional(found->value);
}

std::optional<double> largest_von_mises(const RollingProblem<2>& problem, const LevelSet<2>& shape) {
  const auto solution = problem.solve(shape);
  if (!solution) return std::nullopt;
  return std::ranges::max(peak_von_mises(problem, *solution));
}

std::optional<double> value_of(Quantity quantity, const RollingProblem<2>& problem,
                               const OptimizationState<2>& state) {
  const Evaluation<2>& evaluation = state.evaluation;
  if (quantity == Quantity::objective) return evaluation.objective;
  if (quantity == Quantity::volume_fraction) return volume_fraction(problem.model().grid, state.measure);
  if (quantity == Quantity::peak_von_mises) return largest_von_mises(problem, state.shape);
  if (const auto criterion = named_value(evaluation.criteria, name(quantity))) return criterion;
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

ExpectationWatch::ExpectationWatch(const std::vector<Expectation>& expectations,
                                   const std::vector<FoundQuantity>& found) {
  for (const Expectation& expectation : expectations) {
    const auto noted = std::ranges::find_if(found, [&](const FoundQuantity& f) {
      return expectation.iteration == f.iteration && name(expectation.quantity) == f.quantity;
    });
    findings_.push_back({expectation, noted == found.end() ? std::nullopt : std::optional(noted->value)});
  }
}

void ExpectationWatch::operator()(const RollingProblem<2>& problem, const OptimizationState<2>& state) {
  for (Finding& finding : findings_)
    if (finding.expectation.iteration == state.iteration)
      finding.found = value_of(finding.expectation.quantity, problem, state);
}

std::vector<FoundQuantity> ExpectationWatch::found() const {
  std::vector<FoundQuantity> result;
  for (const auto& [expectation, value] : findings_)
    if (value) result.push_back({*expectation.iteration, std::string(name(expectation.quantity)), *value});
  return result;
}

std::vector<Finding> ExpectationWatch::findings(const RollingProblem<2>& problem,
                                                const OptimizationState<2>& last) const {
  std::vector<Finding> result = findings_;
  for (Finding& finding : result)
    if (!finding.expectation.iteration) finding.found = value_of(finding.expectation.quantity, problem, last);
  return result;
}

}  // namespace wheelwright
