#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/case_key.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

/// The values that the kind of ground needs.
void check_values(const SingleLoad& single, Conflicts& found) {
  const Load& load = single.c.load;
  if (has_ground(load)) return;
  const CaseKey kind = single.key(&Load::ground);
  const auto report = [&](const CaseKey& missing) {
    found.push_back({{kind, missing},
                     fmt::format("the ground \"{}\" needs {}", load.ground, missing.names.front()),
                     fmt::format("set {}, or use ground = \"flat\"", missing.path())});
  };
  report(load.ground == "kerb"      ? single.key(&Load::ground_height)
         : load.ground == "profile" ? single.key(&Load::ground_profile)
                                    : single.key(&Load::ground_radius));
}

/// A wheel that leans rolls inside a drum on its narrower ellipse.
void check_internal_drum(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (c.load.ground != "internal_drum" || !c.load.ground_radius) return;
  const double widest = c.wheel.outer_radius / std::cos(c.load.camber);
  if (*c.load.ground_radius > 1.0001 * widest) return;
  found.push_back(
      {{single.key(&Load::ground_radius), single.key(&Load::ground), key_of(&Wheel::outer_radius)},
       fmt::format("the wheel of {:.6g} m does not fit into the drum", c.wheel.outer_radius),
       fmt::format("use more than {:.6g} m, or ground = \"drum\" for a wheel outside of it", widest)});
}

/// Bars and kerbs whose radius and height contradict each other.
void check_obstacle(const SingleLoad& single, Conflicts& found) {
  const Load& load = single.c.load;
  if (!has_ground(load) || !load.ground_height || !load.ground_radius) return;
  const CaseKeys keys{single.key(&Load::ground_height), single.key(&Load::ground_radius),
                      single.key(&Load::ground)};
  if (load.ground == "bar" && *load.ground_height > 2 * *load.ground_radius)
    found.push_back({keys, "the bar would float above the ground",
                     fmt::format("use at most twice its radius, {:.6g} m", 2 * *load.ground_radius)});
  if (load.ground == "kerb" && *load.ground_radius > *load.ground_height)
    found.push_back({keys, "the edge is rounder than the kerb is high",
                     fmt::format("use ground_radius <= ground_height = {:.6g} m", *load.ground_height)});
}

/// Points that ascend along the ground.
bool is_ascending(const Load& load, const SingleLoad& single, Conflicts& found) {
  for (std::size_t i = 1; i < load.ground_profile.size(); ++i)
    if (!(load.ground_profile[i][0] > load.ground_profile[i - 1][0])) {
      found.push_back({{single.key(&Load::ground_profile)},
                       fmt::format("point {} is not ahead of point {}", i + 1, i),
                       "sort the points by their places along the ground, and give each place once"});
      return false;
    }
  return true;
}

/// The wheel must stand on the ground, not lean against its side.
void check_standing(const SingleLoad& single, Conflicts& found) {
  constexpr double steepest = 60;  // [deg]
  const Case& c = single.c;
  if (!has_ground(c.load) || (c.load.ground == "profile" && !is_ascending(c.load, single, found))) return;
  const double tilt = ground_of(c.load).standing(c.wheel.outer_radius).tilt / (std::acos(-1.0) / 180);
  if (std::abs(tilt) <= steepest) return;
  found.push_back(
      {{single.key(&Load::ground_height), single.key(&Load::ground_place), single.key(&Load::ground_profile),
        single.key(&Load::ground)},
       fmt::format("too high: the wheel would lean against its side, which slopes by {:.0f} degrees "
                   "where they touch",
                   std::abs(tilt)),
       fmt::format("use a lower obstacle, or one further away or nearer to the axle: at most {:.0f} "
                   "degrees are possible",
                   steepest)});
}

/// What is computed only on even ground, or on flat ground.
void check_support(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  if (c.load.ground == "flat" || !has_ground(c.load)) return;
  if (c.contact.with == Counterpart::ring)
    found.push_back({{single.key(&Load::ground), key_of(&Contact::with)},
                     "a tread bonded to a ring does not roll on any ground",
                     "use ground = \"flat\", or contact.with = \"ground\""});
  if (ground_of(c.load).is_even()) return;
  if (c.load.camber != 0)
    found.push_back({{single.key(&Load::camber), single.key(&Load::ground)},
                     "a wheel leans only on flat ground and drums",
                     "use camber = 0, or another ground"});
  if (c.load.speed != 0)
    found.push_back({{single.key(&Load::speed), single.key(&Load::ground)},
                     "a wheel rotates only on flat ground and drums",
                     "use speed = 0, or another ground"});
}

/// Values of a ground that no load has.
void check_unused(const Case& c, Conflicts& found) {
  const auto loads = single_loads(c);
  const auto is_flat = [](const SingleLoad& single) { return single.c.load.ground == "flat"; };
  if (!std::ranges::all_of(loads, is_flat)) return;
  const Load& load = c.load;
  CaseKeys given;
  if (load.ground_radius) given.push_back(key_of(&Load::ground_radius));
  if (load.ground_height) given.push_back(key_of(&Load::ground_height));
  if (load.ground_place != 0) given.push_back(key_of(&Load::ground_place));
  if (!load.ground_profile.empty()) given.push_back(key_of(&Load::ground_profile));
  if (given.empty()) return;
  given.push_back(key_of(&Load::ground));
  found.push_back(
      {given, "without effect: the ground is flat", "omit it, or set load.ground, e.g. to \"drum\""});
}

}  // namespace

void ground_conflicts(const Case& c, Conflicts& found) {
  for (const auto check : {check_values, check_internal_drum, check_obstacle, check_standing, check_support})
    check_loads(single_loads(c), found, check);
  check_unused(c, found);
}

}  // namespace wheelwright
