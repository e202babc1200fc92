#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/case/quantity_needs.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

void check_annulus(const Case& c, Conflicts& found) {
  if (!wants_annulus(c)) return;
  const double cell = polar_grid<2>(c).row_height(c.grid.radial_cells - 1);
  if (std::abs(annulus_thickness(c) - tread_rows(c) * cell) < 1e-6 * cell) return;
  found.push_back({{key_of(&Objective::annulus), key_of(&Grid::radial_cells)},
                   fmt::format("must be a whole number of radial cells of {:.6g} m", cell),
                   fmt::format("nearest valid: {:.6g} m", tread_rows(c) * cell) +
                       if_in_millimetres(annulus_thickness(c), c.wheel.outer_radius)});
}

void check_objective(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  if (o.annulus_matches_dual && o.uniformity_annulus > 0)
    found.push_back({{key_of(&Objective::annulus_matches_dual), key_of(&Objective::uniformity_annulus)},
                     "the weight of J_p1 is given twice",
                     "keep one of annulus_matches_dual and uniformity_annulus"});
  const auto has_weight = [&o](const ObjectiveWeight& term) { return o.*term.weight > 0; };
  const auto is_term = [](const ObjectiveTerm& term) { return term.weight > 0; };
  if (std::ranges::any_of(objective_weights, has_weight) || std::ranges::any_of(o.terms, is_term) ||
      o.annulus_matches_dual || !minimizes_weighted_sum(c))
    return;
  found.push_back({{key_of(&Objective::strain_energy)},
                   "all weights are 0: there is nothing to minimize",
                   "set at least one weight > 0"});
}

/// Checks the further terms of the weighted sum.
void check_terms(const Case& c, Conflicts& found) {
  const std::vector<SingleLoad> loads = single_loads(c, weighted_load_cases(c));
  for (std::size_t i = 0; i < c.objective.terms.size(); ++i) {
    const auto& terms = c.objective.terms;
    const Quantity quantity = quantity_of(c, terms[i]);
    const CaseKey key = key_of(&ObjectiveTerm::quantity, i);
    if (std::ranges::count(terms.begin(), terms.begin() + i, quantity,
                           [&](const ObjectiveTerm& term) { return quantity_of(c, term); }) > 0)
      found.push_back({{key}, "an earlier term has this quantity", "add up their weights in one term"});
    if (objective_weight(name(quantity)))
      found.push_back({{key},
                       "[objective] has a key for its weight",
                       fmt::format("set objective.{} in place of the term", name(quantity))});
    if (const std::string& remedy = quantity->instead; !remedy.empty())
      found.push_back({{key}, "the optimizer has no derivative of it", remedy});
    check_loads(loads, found, [&](const SingleLoad& single, Conflicts& of_case) {
      for (const Need& need : unmet_needs(single, quantity))
        of_case.push_back({{key, need.key}, need.problem, "change that key, or remove the term"});
      if (const auto constant = constancy(single, quantity))
        of_case.push_back(
            {{key, constant->key}, constant->problem, constant->remedy + ", or remove the term"});
    });
  }
}

/// Checks what is minimized instead of the weighted sum.
void check_minimized(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  if (minimizes_weighted_sum(c)) {
    if (o.over != OverPositions::mean)
      found.push_back({{key_of(&Objective::over), key_of(&Objective::minimize)},
                       "the weighted sum is over all load positions",
                       "set objective.minimize too, or omit the key"});
    return;
  }
  if (optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{key_of(&Objective::minimize), key_of(&Optimizer::method)},
                     "steepest descent minimizes only the weighted sum",
                     "use method = \"sequential_quadratic\", or omit the key"});
  if (const std::string& remedy = o.minimize->instead; !remedy.empty())
    found.push_back({{key_of(&Objective::minimize)}, "the optimizer has no derivative of it", remedy});
  const std::vector<SingleLoad> loads = single_loads(c, weighted_load_cases(c));
  check_loads(loads, found, [&](const SingleLoad& single, Conflicts& of_case) {
    for (const Need& need : unmet_needs(single, minimized_quantity(c)))
      of_case.push_back(
          {{key_of(&Objective::minimize), need.key}, need.problem, "change that key, or minimize another"});
    if (const auto constant = constancy(single, o.minimize))
      of_case.push_back({{key_of(&Objective::minimize), constant->key},
                         constant->problem,
                         constant->remedy + ", or minimize another quantity"});
  });
  if (o.minimize->is_amount_of_material && c.constraints.empty())
    found.push_back({{key_of(&Objective::minimize)},
                     "without a constraint the wheel would vanish",
                     "add a [[constraint]], for example on stiffness"});
}

}  // namespace

void objective_conflicts(const Case& c, Conflicts& found) {
  check_annulus(c, found);
  check_objective(c, found);
  check_terms(c, found);
  check_minimized(c, found);
}

}  // namespace wheelwright
