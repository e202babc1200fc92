#include "wheelwright/run/commands/edit_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// Whether a place is within a radius of the axle; false for NaN.
bool is_within(const Point& at, double radius) { return std::hypot(at[0], at[1]) <= radius; }

std::optional<std::string> refused_places(const Wheel& wheel, std::span<const Point> places) {
  const double reach = 2 * wheel.outer_radius;
  const auto outside =
      std::ranges::find_if_not(places, [&](const Point& at) { return is_within(at, reach); });
  if (outside == places.end()) return {};
  return fmt::format("{} is far outside the wheel, whose outer radius is {:.6g} mm", place_text(*outside),
                     1e3 * wheel.outer_radius);
}

/// Distance between the axle and the segment between two points.
double distance_of_axle(const Point& a, const Point& b) {
  const Point along = b - a;
  const double squared = dot<2>(along, along);
  const double t = squared > 0 ? std::clamp(-dot<2>(a, along) / squared, 0.0, 1.0) : 0;
  return norm<2>(a + t * along);
}

bool misses_ring(const Wheel& wheel, std::span<const Point> path, double radius) {
  double nearest = norm<2>(path[0]), farthest = nearest;
  for (std::size_t k = 1; k < path.size(); ++k) {
    nearest = std::min(nearest, distance_of_axle(path[k - 1], path[k]));
    farthest = std::max(farthest, norm<2>(path[k]));
  }
  return nearest - radius >= wheel.outer_radius || farthest + radius <= wheel.inner_radius;
}

}  // namespace

std::optional<std::string> refused_line(const Wheel& wheel, std::span<const Point> path, double radius) {
  if (path.empty() || !(radius > 0)) return "a brush needs a path and a radius above 0";
  if (!(radius <= wheel.outer_radius))
    return fmt::format(
        "a brush of radius {:.6g} mm is larger than the wheel, whose outer radius is {:.6g} mm", 1e3 * radius,
        1e3 * wheel.outer_radius);
  if (auto refused = refused_places(wheel, path)) return refused;
  if (misses_ring(wheel, path, radius))
    return fmt::format("the line at {} misses the ring between the radii {:.6g} and {:.6g} mm",
                       place_text(path[0]), 1e3 * wheel.inner_radius, 1e3 * wheel.outer_radius);
  return {};
}

std::optional<std::string> refused_hole(const Wheel& wheel, std::span<const Point> corners) {
  return refused_places(wheel, corners);
}

std::string place_text(const Point& at) {
  return fmt::format("({:.4g}, {:.4g}) mm", 1e3 * at[0], 1e3 * at[1]);
}

}  // namespace wheelwright
