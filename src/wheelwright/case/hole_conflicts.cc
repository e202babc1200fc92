#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/hole_rings.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/shape_symmetry.h"

namespace wheelwright {

namespace {

/// Finds rings and tables of shapes that are not the same in all sectors. Turned wheels may have none of
/// them at all.
void check_counts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  if (c.optimizer.made == Manufacture::turned) return;
  const auto check = [&](CaseKey key, int count) {
    if (count % c.wheel.sectors == 0) return;
    found.push_back({{std::move(key), key_of(&Wheel::sectors)},
                     fmt::format("must be a multiple of wheel.sectors = {}", c.wheel.sectors),
                     fmt::format("values of wheel.sectors that fit all rings and shapes: {}",
                                 fmt::join(fitting_sectors(c, shapes), ", "))});
  };
  for (std::size_t i = 0; i < c.holes.rings.size(); ++i)
    check(key_of(&HoleRing::count, i), c.holes.rings[i].count);
  for (std::size_t i = 0; i < c.holes.spheres.size(); ++i)
    check(key_of(&HoleSphere::count, i), c.holes.spheres[i].count);
  for (std::size_t i = 0; i < c.holes.tapered.size(); ++i)
    check(key_of(&HoleTapered::count, i), c.holes.tapered[i].count);
  for (const DrawnShape& shape : shapes)
    if (shape.repetition == Repetition::by_count) check(shape.count_key, shape.count);
}

void check_hole_inside(const Case& c, double center_radius, double radius, CaseKeys keys, Conflicts& found) {
  const auto [low, high] = room_for_holes(c);
  const double rounding = 1e-9 * c.wheel.outer_radius;
  const double lowest = center_radius - radius, highest = center_radius + radius;
  if (low >= high || (lowest >= low - rounding && highest <= high + rounding)) return;
  found.push_back(
      {with_ring_shape(std::move(keys)),
       fmt::format("the hole extends from radius {:.6g} m to {:.6g} m; between the bands at rim and "
                   "tread there is only {:.6g} m to {:.6g} m",
                   lowest, highest, low, high),
       fmt::format("the largest hole at this place has radius {:.6g} m",
                   std::max(0.0, std::min(center_radius - low, high - center_radius))) +
           if_in_millimetres(std::max(center_radius, radius), c.wheel.outer_radius) +
           if_in_millimetres(c.wheel.outer_radius, 2 * highest)});
}

/// Equal holes that touch all around the wheel cut the tread off from the rim.
void check_holes_apart(int count, double center_radius, double radius, CaseKeys keys, Conflicts& found) {
  const double half_distance = center_radius * std::sin(std::numbers::pi / count);
  if (count == 1 || radius < half_distance) return;
  found.push_back({std::move(keys), "neighbouring holes touch and cut the tread off from the rim",
                   fmt::format("use a radius below {:.6g} m", half_distance)});
}

/// A hole inside another one has no effect.
void check_nested_holes(const Case& c, Conflicts& found) {
  constexpr std::size_t most_compared = 1000;
  const std::vector<NamedRing> rings = named_rings(c);
  if (rings.size() > most_compared) return;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto contains = [&](const NamedRing& other) {
      const bool is_same = lies_inside(other.ring, rings[i].ring);
      return &other != &rings[i] && lies_inside(rings[i].ring, other.ring) &&
             (!is_same || &other < &rings[i]);
    };
    const auto outer = std::ranges::find_if(rings, contains);
    if (outer == rings.end()) continue;
    const bool is_same = lies_inside(outer->ring, rings[i].ring);
    const CaseKey repetition = key_of(&Wheel::sectors);  // of circles
    found.push_back(
        {.keys = joined({rings[i].place, outer->place, {repetition}}),
         .problem = fmt::format(
             "{} {}", is_same ? "the same hole as that of" : "the hole lies inside that of", outer->name),
         .remedy = "remove one of the two, or move it",
         .other_place = outer->place.front()});
  }
}

void check_holes(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.rings.size(); ++i) {
    const HoleRing& ring = c.holes.rings[i];
    const CaseKeys keys{key_of(&HoleRing::radius, i), key_of(&HoleRing::center_radius, i)};
    check_hole_inside(c, ring.center_radius, ring.radius, keys, found);
    check_holes_apart(ring.count, ring.center_radius, ring.radius,
                      {keys[0], keys[1], key_of(&HoleRing::count, i)}, found);
  }
  for (std::size_t i = 0; i < c.holes.circles.size(); ++i) {
    const HoleCircle& circle = c.holes.circles[i];
    const double center_radius = std::hypot(circle.center[0], circle.center[1]);
    const CaseKeys keys{key_of(&HoleCircle::radius, i), key_of(&HoleCircle::center, i)};
    check_hole_inside(c, center_radius, circle.radius, keys, found);
    check_holes_apart(c.wheel.sectors, center_radius, circle.radius,
                      {keys[0], keys[1], key_of(&Wheel::sectors)}, found);
  }
}

/// A sphere must intersect the wheel.
void check_spheres(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.spheres.size(); ++i) {
    const HoleSphere& sphere = c.holes.spheres[i];
    check_hole_inside(c, sphere.center_radius, sphere.radius,
                      {key_of(&HoleSphere::radius, i), key_of(&HoleSphere::center_radius, i)}, found);
    const double reach = 0.5 * c.wheel.width + sphere.radius;
    if (std::abs(sphere.z) < reach) continue;
    found.push_back(
        {{key_of(&HoleSphere::z, i), key_of(&HoleSphere::radius, i), key_of(&Wheel::width)},
         "the hole lies outside the wheel",
         fmt::format("use a value between {:.6g} m and {:.6g} m: z is measured from the middle of the width",
                     -reach, reach)});
  }
}

/// The profile of a tapered hole ascends, and its widest place is a ring.
void check_tapered(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.tapered.size(); ++i) {
    const HoleTapered& hole = c.holes.tapered[i];
    const CaseKey profile = key_of(&HoleTapered::profile, i);
    double widest = 0;
    bool ascends = true;
    for (std::size_t k = 0; k < hole.profile.size(); ++k) {
      widest = std::max(widest, hole.profile[k][1]);
      ascends = ascends && (k == 0 || hole.profile[k][0] > hole.profile[k - 1][0]);
    }
    if (!ascends)
      found.push_back({{profile},
                       "the positions along the axle do not increase from point to point",
                       "sort the points by their first number"});
    const CaseKeys keys{profile, key_of(&HoleTapered::center_radius, i)};
    if (widest <= 0) {
      found.push_back({keys, "no radius is positive, so there is no hole", "set radii > 0"});
      continue;
    }
    check_hole_inside(c, hole.center_radius, widest, keys, found);
    check_holes_apart(hole.count, hole.center_radius, widest,
                      {keys[0], keys[1], key_of(&HoleTapered::count, i)}, found);
  }
}

/// A groove has room between the bands and in the width, and for its corners.
void check_grooves(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.grooves.size(); ++i) {
    const HoleGroove& groove = c.holes.grooves[i];
    const CaseKey inner = key_of(&HoleGroove::inner_radius, i), outer = key_of(&HoleGroove::outer_radius, i),
                  depth = key_of(&HoleGroove::depth, i);
    if (groove.inner_radius >= groove.outer_radius) {
      found.push_back({{inner, outer}, "the groove has no width", "set outer_radius > inner_radius"});
      continue;
    }
    const auto [low, high] = room_for_holes(c);
    const double rounding = 1e-9 * c.wheel.outer_radius;
    if (low < high && (groove.inner_radius < low - rounding || groove.outer_radius > high + rounding))
      found.push_back({with_ring_shape({inner, outer}), "the groove reaches into the bands at rim and tread",
                       fmt::format("use radii from {:.6g} m to {:.6g} m", low, high) +
                           if_in_millimetres(groove.outer_radius, high)});
    const double most = groove.side == GrooveSide::both ? 0.5 * c.wheel.width : c.wheel.width;
    const bool leans_inwards = groove.outer_depth && *groove.outer_depth < groove.depth;
    const CaseKey deepest =
        groove.outer_depth && !leans_inwards ? key_of(&HoleGroove::outer_depth, i) : depth;
    if (const double reach = largest_depth(groove); reach >= most)
      found.push_back({{deepest, key_of(&Wheel::width)},
                       "the groove would cut the wheel into rings",
                       fmt::format("use less than {:.6g} m", most) + if_in_millimetres(reach, most)});
    if (const double fillet = largest_fillet(groove); groove.fillet.value_or(0) > fillet)
      found.push_back({{key_of(&HoleGroove::fillet, i), depth, inner, outer},
                       "the corners have no room",
                       fmt::format("use at most {:.6g} m", fillet)});
  }
}

}  // namespace

void hole_conflicts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  check_counts(c, shapes, found);
  check_holes(c, found);
  check_nested_holes(c, found);
  check_spheres(c, found);
  check_tapered(c, found);
  check_grooves(c, found);
}

}  // namespace wheelwright
