#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/names.h"
#include "wheelwright/case/overload.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

void check_travel(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  const double thickness = c.wheel.outer_radius - c.wheel.inner_radius;
  if (!c.load.travel || thickness <= 0 || *c.load.travel < thickness) return;
  found.push_back({{single.key(&Load::travel), key_of(&Wheel::outer_radius), key_of(&Wheel::inner_radius)},
                   "the rim itself would be below the ground",
                   fmt::format("use less than outer_radius - inner_radius = {:.6g} m", thickness) +
                       if_in_millimetres(*c.load.travel, c.wheel.outer_radius)});
}

void check_load(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (is_overloaded_in_pascals(c)) {
    const PlacedMaterial tread = placed_materials(c).back();
    found.push_back({{tread.youngs_modulus_key(), single.key(&Load::force)},
                     "so small that the load would flatten a solid disc",
                     question_of_megapascals(tread.youngs_modulus())});
    return;
  }
  if (!is_overloaded(c)) return;
  const double half_width = hertz_half_width(c);
  const double advised = 0.1 * contact_radius(c), factor = advised / half_width;  // strains of 5 %
  CaseKeys keys{single.key(&Load::force),     key_of(&Material::youngs_modulus), key_of(&Wheel::width),
                key_of(&Wheel::outer_radius), key_of(&Material::poissons_ratio), key_of(&Material::plane)};
  std::ranges::move(keys_of_moduli(c), std::back_inserter(keys));
  found.push_back(
      {std::move(keys),
       fmt::format("too large: a solid disc would touch the ground on {:.3g} m and be strained by "
                   "about {:.0f} %, far beyond linear elasticity",
                   2 * half_width, 100 * half_width / (2 * contact_radius(c))),
       fmt::format("use at most {:.3g} N, or a stiffer material", c.load.force * factor * factor)});
}

/// The nominal strain of the walls between the holes of a ring: the load spreads below the patch by 45
/// degrees, and the holes leave a part of each circle.
double wall_strain(const Case& c, const HoleRing& ring) {
  const double spread = 2 * hertz_half_width(c) + 2 * (c.wheel.outer_radius - ring.center_radius),
               left = 1 - ring.count * ring.radius / (std::numbers::pi * ring.center_radius);
  return c.load.force / (c.wheel.width * modulus_at(c, ring.center_radius) * spread * left);
}

/// Reports loads that would crush the walls between holes. This is an estimate, used only if the case has
/// other problems; otherwise a solve decides.
void check_walls(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  constexpr double largest = 0.25, advised = 0.05;
  if (c.load.travel || c.contact.with == Counterpart::ring || is_overloaded_in_pascals(c)) return;
  double strain = 0;
  for (const HoleRing& ring : c.holes.rings) strain = std::max(strain, wall_strain(c, ring));
  if (strain <= largest) return;
  found.push_back(
      {{single.key(&Load::force), key_of(&Material::youngs_modulus), key_of(&Wheel::width)},
       fmt::format("too large: the walls between the holes would be strained by about {:.0f} %, far "
                   "beyond linear elasticity",
                   100 * strain),
       fmt::format("use at most {:.3g} N, smaller holes or a stiffer material",
                   c.load.force * std::pow(advised / strain, 2))});
}

/// Friction must resist the force or torque that moves or turns the rim.
void check_friction(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (c.contact.with == Counterpart::ring) return;
  const Load& load = c.load;
  if (load.horizontal_force != 0 && load.torque != 0)
    found.push_back(
        {{single.key(&Load::torque), single.key(&Load::horizontal_force)},
         "the wheel would roll away: friction can resist a horizontal force or a torque, not both",
         "keep one of torque and horizontal_force"});
  const double arm = c.wheel.outer_radius, held = c.contact.friction * load.force;
  const auto check = [&](const CaseKey& key, double value, double limit, const char* unit) {
    if (value == 0) return;
    if (c.contact.friction == 0)
      found.push_back({{key, key_of(&Contact::friction)},
                       "without friction nothing holds the wheel",
                       "set contact.friction > 0"});
    else if (!load.travel && load.body_force == std::array<double, 2>{} && std::abs(value) >= limit)
      found.push_back(
          {{key, key_of(&Contact::friction), single.key(&Load::force)},
           fmt::format("the wheel would slide: friction resists less than {:.6g} {}", limit, unit),
           "use a smaller value, or more contact.friction"});
  };
  check(single.key(&Load::horizontal_force), load.horizontal_force, held, "N");
  if (!has_large_strains(c))  // which refuse any torque
    check(single.key(&Load::torque), load.torque, held * arm, "N m");
  check(single.key(&Load::lateral_force), load.lateral_force, held, "N");
  const double along_ground = std::hypot(load.horizontal_force, load.lateral_force);
  if (!load.travel && load.horizontal_force != 0 && load.lateral_force != 0 && along_ground >= held &&
      std::max(std::abs(load.horizontal_force), std::abs(load.lateral_force)) < held)
    found.push_back(
        {{single.key(&Load::lateral_force), single.key(&Load::horizontal_force), key_of(&Contact::friction)},
         fmt::format("the wheel would slide: both forces together are {:.6g} N, and friction "
                     "resists less than {:.6g} N",
                     along_ground, held),
         "use smaller values, or more contact.friction"});
}

/// The strain of a rotating ring held only at the rim: the centrifugal force of all its mass over the area at
/// the rim and the modulus there.
double rotation_strain(const Case& c) {
  const std::vector<PlacedMaterial> ring = placed_materials(c);
  const auto square = [&](double radius) { return std::pow(radius / c.wheel.outer_radius, 2); };
  double mass = 0;  // over the area of the whole disc
  for (const PlacedMaterial& placed : ring)
    mass += *placed.density() * (square(placed.outer_radius) - square(placed.inner_radius));
  return 0.5 * mass * c.load.speed * c.load.speed / ring.front().contact_modulus();
}

/// The centrifugal load needs a mass, and must strain the wheel by less than a quarter.
void check_speed(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (c.load.speed == 0) return;
  if (!has_density(c)) {
    found.push_back({{single.key(&Load::speed), key_of(&Material::density)},
                     "the centrifugal load needs the density of every material",
                     c.layers.empty() ? "set material.density"
                                      : "set material.density, and that of each [[material.layer]]"});
    return;
  }
  constexpr double largest = 0.25, advised = 0.05;
  const double strain = rotation_strain(c);
  if (strain <= largest) return;
  found.push_back({{single.key(&Load::speed), key_of(&Material::density), key_of(&Material::youngs_modulus),
                    key_of(&Wheel::outer_radius), key_of(&Wheel::inner_radius),
                    key_of(&Material::poissons_ratio), key_of(&Material::plane)},
                   fmt::format("too large: the centrifugal load would strain the ring by about {:.0f} %, far "
                               "beyond linear elasticity",
                               100 * strain),
                   fmt::format("use at most {:.3g} m/s, or a stiffer material",
                               c.load.speed * std::sqrt(advised / strain))});
}

/// A loss factor over the frequency needs a speed; under load cases in which the wheel stands it is that of
/// the lowest frequency.
void check_frequencies(const Case& c, Conflicts& found) {
  const auto loads = single_loads(c);
  if (std::ranges::any_of(loads, [](const SingleLoad& single) { return single.c.load.speed > 0; })) return;
  for (const PlacedMaterial& placed : placed_materials(c))
    if (const auto factor = placed.loss_factor(); factor && !factor->table().empty()) {
      found.push_back({{placed.loss_factor_key(), loads.front().key(&Load::speed)},
                       "a loss factor over the frequency needs the speed of the wheel",
                       "set load.speed, or one number for all frequencies"});
      return;
    }
}

/// Checks the list of load cases, and references to them.
void check_names_of_load_cases(const Case& c, Conflicts& found) {
  const auto& cases = c.load.cases;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const CaseKey key = key_of(&CaseLoad::name, k);
    if (!is_word(cases[k].name))
      found.push_back({{key}, "the name must be one word of letters, digits, - and _", "use another name"});
    if (std::ranges::find(names, cases[k].name) != names.end())
      found.push_back({{key}, "another load case has this name", "use a unique name"});
    names.push_back(cases[k].name);
  }
  const auto check_named = [&](const CaseKey& key, const std::string& name) {
    if (name.empty() || std::ranges::find(names, name) != names.end()) return;
    found.push_back({{key},
                     "there is no load case with this name",
                     names.empty() ? "add a [[load.case]], or omit the key"
                                   : fmt::format("known: {}", fmt::join(names, ", "))});
  };
  for (std::size_t i = 0; i < c.constraints.size(); ++i)
    check_named(key_of(&Constraint::load_case, i), c.constraints[i].load_case);
  for (std::size_t i = 0; i < c.expectations.size(); ++i)
    check_named(key_of(&Expectation::load_case, i), c.expectations[i].load_case);
  if (cases.empty()) return;
  if (weighted_load_cases(c).empty())
    found.push_back({{key_of(&CaseLoad::weight, 0)},
                     "the weights of all load cases are 0: there is nothing to minimize",
                     "set at least one weight > 0"});
  if (c.objective.mean == MeanStress::held)
    found.push_back({{key_of(&Objective::mean), key_of(&CaseLoad::name, 0)},
                     "the held mean of the contact stress is defined for only one load",
                     "use mean = \"exact\", or one load"});
  if (c.objective.annulus_matches_dual)
    found.push_back({{key_of(&Objective::annulus_matches_dual), key_of(&CaseLoad::name, 0)},
                     "(83) determines the weight of J_p1 for only one load",
                     "set uniformity_annulus, or use one load"});
}

/// The shares of the distance that load cases are driven for divide all of it among them, and need lives.
void check_distance_shares(const Case& c, Conflicts& found) {
  constexpr double rounding = 1e-4;  // of shares such as 0.3333
  std::vector<std::string> without;
  std::optional<std::size_t> first;
  double sum = 0;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k) {
    const CaseLoad& load_case = c.load.cases[k];
    sum += load_case.distance_share.value_or(0);
    if (!load_case.distance_share) without.push_back(load_case.name);
    if (load_case.distance_share && !first) first = k;
  }
  if (!first) return;
  const CaseKey key = key_of(&CaseLoad::distance_share, *first);
  if (!without.empty())
    found.push_back({{key},
                     fmt::format("load cases without a share of the distance: {}", fmt::join(without, ", ")),
                     "add distance_share to each, 0 if it is not driven, or omit all"});
  else if (std::abs(sum - 1) > rounding)
    found.push_back({{key},
                     fmt::format("the shares of all load cases must sum to 1; they sum to {:.6g}", sum),
                     sum > 0 ? fmt::format("divide each by {:.6g}", sum) : "set at least one share > 0"});
  if (!has_fatigue_exponent(c))
    found.push_back({{key, key_of(&RingMaterial::fatigue_exponent)},
                     "without effect unless every material has a fatigue life",
                     "set fatigue_measure, its limit and fatigue_exponent of each, or omit the shares"});
}

}  // namespace

void load_conflicts(const Case& c, Conflicts& found) {
  for (const auto check : {check_travel, check_load, check_friction, check_speed})
    check_loads(single_loads(c), found, check);
  check_names_of_load_cases(c, found);
  check_distance_shares(c, found);
  check_frequencies(c, found);
}

void wall_conflicts(const Case& c, Conflicts& found) { check_loads(single_loads(c), found, check_walls); }

}  // namespace wheelwright
