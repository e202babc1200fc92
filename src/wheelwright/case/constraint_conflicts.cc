#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/quantity_needs.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

/// A bound of a constraint: regardless of the positions, a lower bound above an upper one contradicts it.
struct OneBound {
  CaseKey key;
  double value;
  std::string text;  ///< of the value
};

OneBound one_bound(const Case& c, std::size_t i, CaseKey key, double value) {
  return {std::move(key), value, shown_text(c.constraints[i].quantity, value, c.wheel)};
}

std::optional<OneBound> lower_bound(const Case& c, std::size_t i) {
  const Constraint& constraint = c.constraints[i];
  const auto& value = constraint.equals ? constraint.equals : constraint.at_least;
  if (!value) return {};
  return one_bound(
      c, i, constraint.equals ? key_of(&Constraint::equals, i) : key_of(&Constraint::at_least, i), *value);
}

std::optional<OneBound> upper_bound(const Case& c, std::size_t i) {
  const Constraint& constraint = c.constraints[i];
  const auto& value = constraint.equals ? constraint.equals : constraint.at_most;
  if (!value) return {};
  return one_bound(c, i, constraint.equals ? key_of(&Constraint::equals, i) : key_of(&Constraint::at_most, i),
                   *value);
}

/// Finds contradictory bounds of one quantity in two tables.
void check_bounds_together(const Case& c, Conflicts& found) {
  const auto meet = [&](const Constraint& a, const Constraint& b) {
    return quantity_of(c, a) == quantity_of(c, b) &&
           (a.load_case.empty() || b.load_case.empty() || a.load_case == b.load_case);
  };
  const auto check = [&](const std::optional<OneBound>& lower, const std::optional<OneBound>& upper,
                         bool lower_is_later) {
    if (!lower || !upper || lower->value <= upper->value) return;
    const OneBound &later = lower_is_later ? *lower : *upper, &earlier = lower_is_later ? *upper : *lower;
    found.push_back({.keys = {later.key, earlier.key},
                     .problem = fmt::format("contradicts {} = {}: no wheel satisfies both",
                                            earlier.key.path(), earlier.text),
                     .remedy = "change one of them, or remove it",
                     .other_place = earlier.key});
  };
  for (std::size_t i = 0; i < c.constraints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (!meet(c.constraints[i], c.constraints[k])) continue;
      check(lower_bound(c, i), upper_bound(c, k), true);
      check(lower_bound(c, k), upper_bound(c, i), false);
    }
}

/// Bounds of one table that no wheel can satisfy, or whose side is unclear.
void check_bounds(const Case& c, std::size_t i, Conflicts& found) {
  const Constraint& constraint = c.constraints[i];
  const CaseKey at_least = key_of(&Constraint::at_least, i), at_most = key_of(&Constraint::at_most, i),
                equals = key_of(&Constraint::equals, i);
  const auto refuse = [&](CaseKeys keys, std::string problem, std::string remedy) {
    found.push_back({std::move(keys), std::move(problem), std::move(remedy)});
  };
  if (!constraint.at_least && !constraint.at_most && !constraint.equals)
    refuse({key_of(&Constraint::quantity, i), at_least, at_most, equals}, "no bound is given",
           "add at_least, at_most or equals");
  if (constraint.equals && (constraint.at_least || constraint.at_most))
    refuse({equals}, "a value and bounds are given", "keep one of them");
  if (constraint.at_least && constraint.at_most && *constraint.at_least >= *constraint.at_most)
    refuse({at_least},
           fmt::format("must be less than at_most = {}",
                       shown_text(constraint.quantity, *constraint.at_most, c.wheel)),
           "swap them, or use equals");
  if (constraint.over == OverPositions::worst &&
      (constraint.equals || (constraint.at_least && constraint.at_most)))
    refuse({key_of(&Constraint::over, i)}, "the worst position depends on the side of the bound",
           "set one bound, or over = \"each\"");
  for (const auto& [key, bound] :
       {std::pair{at_least, constraint.at_least}, std::pair{equals, constraint.equals}})
    if (constraint.quantity == built_in("volume_fraction") && bound && *bound >= 1)
      refuse({key}, "more than the whole ring", "use a fraction below 1");
}

/// Bounds of motions far beyond the size of the wheel, which were not meant in metres.
void check_motions(const Case& c, std::size_t i, Conflicts& found) {
  constexpr double most = 5;  // radii
  const auto is_bounded = [&](const char* quantity) {
    return c.constraints[i].quantity == built_in(quantity);
  };
  if (!is_bounded("travel") && !is_bounded("mean_travel") && !is_bounded("run_out")) return;
  for (const auto& bound : {lower_bound(c, i), upper_bound(c, i)}) {
    if (!bound || bound->value < most * c.wheel.outer_radius) continue;
    found.push_back({{bound->key, key_of(&Wheel::outer_radius)},
                     "many times the radius of the wheel",
                     fmt::format("use less than {:.6g} m", c.wheel.outer_radius) +
                         if_in_millimetres(bound->value, c.wheel.outer_radius)});
    return;  // equals is both bounds
  }
}

/// Strains are fractions.
void check_strains(const Case& c, std::size_t i, Conflicts& found) {
  constexpr double largest = 5;
  const auto upper = upper_bound(c, i);
  if (c.constraints[i].quantity != built_in("largest_strain") || !upper || upper->value < largest) return;
  found.push_back({{upper->key},
                   fmt::format("no wheel is strained by {:.0f} %", 100 * upper->value),
                   fmt::format("strains are fractions: if {0:g} is in per cent, write {1:g}", upper->value,
                               upper->value / 100)});
}

/// Upper bounds of temperatures that no shape can meet: the losses only warm the wheel, and the rim belongs
/// to it.
void check_temperature(const Case& c, std::size_t i, Conflicts& found) {
  const auto cooled = cooling(c);
  const auto upper = upper_bound(c, i);
  if (!c.constraints[i].quantity->depends_on_heat || !cooled || !upper) return;
  const auto part = quantity_of(c, c.constraints[i])->part;
  const auto rim = cooled->rim_temperature;
  const bool has_rim = !part || part->name == placed_materials(c).front().name,
             is_below_rim = rim && has_rim && upper->value < *rim;
  if (!is_below_rim && upper->value > cooled->coldest()) return;
  const bool is_of_rim = is_below_rim || (rim && *rim < cooled->ambient_temperature);
  const CaseKey key = is_of_rim ? key_of(&Heat::rim_temperature) : key_of(&Heat::ambient_temperature);
  found.push_back({{upper->key, key},
                   fmt::format("no shape can meet it: {} = {:g} deg C, and the losses only warm the wheel",
                               key.path(), is_of_rim ? *rim : cooled->ambient_temperature),
                   fmt::format("use more than that, or a lower {}", key.path())});
}

/// Quantities that a run cannot bound.
void check_quantity(const Case& c, std::size_t i, Conflicts& found) {
  const Constraint& constraint = c.constraints[i];
  const CaseKey quantity = key_of(&Constraint::quantity, i);
  if (optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{quantity, key_of(&Optimizer::method)},
                     "steepest descent does not support constraints",
                     "use method = \"sequential_quadratic\""});
  if (const std::string& remedy = constraint.quantity->instead; !remedy.empty())
    found.push_back({{quantity}, "the optimizer has no derivative of it", remedy});
  const auto loads = single_loads(c, load_cases_of(c, constraint));
  check_loads(loads, found, [&](const SingleLoad& single, Conflicts& of_case) {
    for (const Need& need : unmet_needs(single, quantity_of(c, constraint)))
      of_case.push_back({{quantity, need.key}, need.problem, "change that key, or bound another quantity"});
    if (const auto constant = constancy(single, constraint.quantity))
      of_case.push_back(
          {{quantity, constant->key}, constant->problem, constant->remedy + ", or bound another quantity"});
  });
}

}  // namespace

void constraint_conflicts(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.constraints.size(); ++i) {
    check_quantity(c, i, found);
    check_bounds(c, i, found);
    check_motions(c, i, found);
    check_strains(c, i, found);
    check_temperature(c, i, found);
  }
  check_bounds_together(c, found);
  if (!holds_volume(c) && c.volume.target)
    found.push_back({{key_of(&Volume::target)},
                     "the volume is free, because it is bounded or minimized",
                     "omit the key, or bound volume_fraction instead"});
}

}  // namespace wheelwright
