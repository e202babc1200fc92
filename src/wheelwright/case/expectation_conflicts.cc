#include <fmt/format.h>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/case/quantity_needs.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

/// Finds expectations of quantities that the run does not compute, or of shapes that it does not reach.
void expectation_conflicts(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  const auto has_weight = [&o](const ObjectiveWeight& term) {
    return o.*term.weight > 0 || (term.weight == &Objective::uniformity_annulus && o.annulus_matches_dual);
  };
  for (std::size_t i = 0; i < c.expectations.size(); ++i) {
    const Expectation& expectation = c.expectations[i];
    const auto key = [&](std::string_view name) { return fmt::format("expect[{}].{}", i + 1, name); };
    if (const auto* term = objective_weight(name(expectation.quantity)); term && !has_weight(*term))
      found.push_back({{key("quantity"), fmt::format("objective.{}", name(expectation.quantity))},
                       "it has no weight in the objective, so the run does not compute it",
                       "set a weight, however small, or expect another quantity"});
    for (const Need& need :
         unmet_needs(single_load_cases(c)[load_case_of(c, expectation)], expectation.quantity))
      found.push_back(
          {{key("quantity"), need.key}, need.problem, "change that key, or expect another quantity"});
    if (expectation.iteration && *expectation.iteration > c.optimizer.iterations)
      found.push_back({{key("iteration"), "optimizer.iterations"},
                       fmt::format("the run ends at shape {} at the latest", c.optimizer.iterations),
                       "use an earlier shape, or omit the key for the last shape"});
  }
}

}  // namespace wheelwright
