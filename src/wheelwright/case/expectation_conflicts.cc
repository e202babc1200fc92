#include <fmt/format.h>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/case/quantity_needs.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

/// Finds expectations of quantities that the run does not compute, or of shapes that it does not reach.
void expectation_conflicts(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  const auto has_weight = [&o](const ObjectiveWeight& term) {
    return o.*term.weight > 0 || (term.weight == &Objective::uniformity_annulus && o.annulus_matches_dual);
  };
  for (std::size_t i = 0; i < c.expectations.size(); ++i) {
    const Expectation& expectation = c.expectations[i];
    const CaseKey quantity = key_of(&Expectation::quantity, i);
    if (const auto* term = objective_weight(name(expectation.quantity)); term && !has_weight(*term))
      found.push_back({{quantity, key_of(term->weight)},
                       "it has no weight in the objective, so the run does not compute it",
                       "set a weight, however small, or expect another quantity"});
    for (const Need& need :
         unmet_needs(single_loads(c)[load_case_of(c, expectation)], quantity_of(c, expectation)))
      found.push_back({{quantity, need.key}, need.problem, "change that key, or expect another quantity"});
    if (expectation.iteration && *expectation.iteration > c.optimizer.iterations)
      found.push_back({{key_of(&Expectation::iteration, i), key_of(&Optimizer::iterations)},
                       fmt::format("the run ends at shape {} at the latest", c.optimizer.iterations),
                       "use an earlier shape, or omit the key for the last shape"});
  }
}

}  // namespace wheelwright
