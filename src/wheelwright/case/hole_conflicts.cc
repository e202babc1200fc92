#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/hole_rings.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/shape_symmetry.h"

namespace wheelwright {

namespace {

std::string ring_key(std::size_t i, std::string_view name) {
  return fmt::format("holes.ring[{}].{}", i + 1, name);
}

std::string circle_key(std::size_t i, std::string_view name) {
  return fmt::format("holes.circle[{}].{}", i + 1, name);
}

/// Finds rings and tables of shapes that are not the same in all sectors.
void check_counts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  const auto check = [&](std::string key, int count) {
    if (count % c.wheel.sectors == 0) return;
    found.push_back({{std::move(key), "wheel.sectors"},
                     fmt::format("must be a multiple of wheel.sectors = {}", c.wheel.sectors),
                     fmt::format("values of wheel.sectors that fit all rings and shapes: {}",
                                 fmt::join(fitting_sectors(c, shapes), ", "))});
  };
  for (std::size_t i = 0; i < c.holes.rings.size(); ++i) check(ring_key(i, "count"), c.holes.rings[i].count);
  for (std::size_t i = 0; i < c.holes.spheres.size(); ++i)
    check(fmt::format("holes.sphere[{}].count", i + 1), c.holes.spheres[i].count);
  for (std::size_t i = 0; i < c.holes.tapered.size(); ++i)
    check(fmt::format("holes.tapered[{}].count", i + 1), c.holes.tapered[i].count);
  for (const DrawnShape& shape : shapes)
    if (shape.repetition == Repetition::by_count) check(shape.key + ".count", shape.count);
}

void check_hole_inside(const Case& c, double center_radius, double radius, std::vector<std::string> keys,
                       Conflicts& found) {
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
void check_holes_apart(int count, double center_radius, double radius, std::vector<std::string> keys,
                       Conflicts& found) {
  const double half_distance = center_radius * std::sin(std::numbers::pi / count);
  if (count == 1 || radius < half_distance) return;
  found.push_back({std::move(keys), "neighbouring holes touch and cut the tread off from the rim",
                   fmt::format("use a radius below {:.6g} m", half_distance)});
}

/// The keys for the positions of the holes of a ring or circle, its radius first.
std::vector<std::string> place_keys(const std::string& name) {
  std::vector<std::string> keys;
  for (const char* key : {"radius", "center_radius", "center", "count", "phase"})
    keys.push_back(fmt::format("{}.{}", name, key));
  return keys;
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
    std::vector<std::string> keys = place_keys(rings[i].name);
    std::ranges::move(place_keys(outer->name), std::back_inserter(keys));
    keys.emplace_back("wheel.sectors");  // how often a circle is repeated
    found.push_back(
        {.keys = std::move(keys),
         .problem = fmt::format(
             "{} {}", is_same ? "the same hole as that of" : "the hole lies inside that of", outer->name),
         .remedy = "remove one of the two, or move it",
         .other_place = outer->name + ".radius"});
  }
}

void check_holes(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.rings.size(); ++i) {
    const HoleRing& ring = c.holes.rings[i];
    const std::vector<std::string> keys{ring_key(i, "radius"), ring_key(i, "center_radius")};
    check_hole_inside(c, ring.center_radius, ring.radius, keys, found);
    check_holes_apart(ring.count, ring.center_radius, ring.radius, {keys[0], keys[1], ring_key(i, "count")},
                      found);
  }
  for (std::size_t i = 0; i < c.holes.circles.size(); ++i) {
    const HoleCircle& circle = c.holes.circles[i];
    const double center_radius = std::hypot(circle.center[0], circle.center[1]);
    const std::vector<std::string> keys{circle_key(i, "radius"), circle_key(i, "center")};
    check_hole_inside(c, center_radius, circle.radius, keys, found);
    check_holes_apart(c.wheel.sectors, center_radius, circle.radius, {keys[0], keys[1], "wheel.sectors"},
                      found);
  }
}

/// A sphere must intersect the wheel.
void check_spheres(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.spheres.size(); ++i) {
    const HoleSphere& sphere = c.holes.spheres[i];
    const auto key = [&](std::string_view name) { return fmt::format("holes.sphere[{}].{}", i + 1, name); };
    check_hole_inside(c, sphere.center_radius, sphere.radius, {key("radius"), key("center_radius")}, found);
    const double reach = 0.5 * c.wheel.width + sphere.radius;
    if (std::abs(sphere.z) < reach) continue;
    found.push_back(
        {{key("z"), key("radius"), "wheel.width"},
         "the hole lies outside the wheel",
         fmt::format("use a value between {:.6g} m and {:.6g} m: z is measured from the middle of the width",
                     -reach, reach)});
  }
}

/// The profile of a tapered hole ascends, and its widest place is a ring.
void check_tapered(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.tapered.size(); ++i) {
    const HoleTapered& hole = c.holes.tapered[i];
    const auto key = [&](std::string_view name) { return fmt::format("holes.tapered[{}].{}", i + 1, name); };
    double widest = 0;
    bool ascends = true;
    for (std::size_t k = 0; k < hole.profile.size(); ++k) {
      widest = std::max(widest, hole.profile[k][1]);
      ascends = ascends && (k == 0 || hole.profile[k][0] > hole.profile[k - 1][0]);
    }
    if (!ascends)
      found.push_back({{key("profile")},
                       "the positions along the axle do not increase from point to point",
                       "sort the points by their first number"});
    const std::vector<std::string> keys{key("profile"), key("center_radius")};
    if (widest <= 0) {
      found.push_back({keys, "no radius is positive, so there is no hole", "set radii > 0"});
      continue;
    }
    check_hole_inside(c, hole.center_radius, widest, keys, found);
    check_holes_apart(hole.count, hole.center_radius, widest, {keys[0], keys[1], key("count")}, found);
  }
}

}  // namespace

void hole_conflicts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  check_counts(c, shapes, found);
  check_holes(c, found);
  check_nested_holes(c, found);
  check_spheres(c, found);
  check_tapered(c, found);
}

}  // namespace wheelwright
