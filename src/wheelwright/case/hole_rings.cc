#include "wheelwright/case/hole_rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace wheelwright {
namespace {

using std::numbers::pi;

/// Beyond this number of rings, pairs are too many to compare.
constexpr std::size_t most_compared = 1000;

double centre_distance(const HoleRing& a, const HoleRing& b, double azimuth) {
  const double chord = 2 * std::sqrt(a.center_radius * b.center_radius) * std::sin(azimuth / 2);
  return std::hypot(a.center_radius - b.center_radius, chord);
}

}  // namespace

std::vector<NamedRing> named_rings(const Case& c) {
  std::vector<NamedRing> rings;
  for (const HoleRing& ring : c.holes.rings) {
    const std::size_t i = rings.size();
    rings.push_back({table_of<HoleRing>(i).path(),
                     {key_of(&HoleRing::radius, i), key_of(&HoleRing::center_radius, i),
                      key_of(&HoleRing::count, i), key_of(&HoleRing::phase, i)},
                     ring});
    if (!ring.phase) rings.back().ring.phase = pi / ring.count;
  }
  for (std::size_t i = 0; i < c.holes.circles.size(); ++i) {
    const HoleCircle& circle = c.holes.circles[i];
    const auto [x, y] = circle.center;
    rings.push_back({table_of<HoleCircle>(i).path(),
                     {key_of(&HoleCircle::radius, i), key_of(&HoleCircle::center, i)},
                     {.count = c.wheel.sectors,
                      .center_radius = std::hypot(x, y),
                      .radius = circle.radius,
                      .phase = std::atan2(y, x)}});
  }
  return rings;
}

/// The azimuths from the holes of `a` to a hole of `b` are equally spaced, since both rings are.
AzimuthOffsets azimuth_offsets(const HoleRing& a, const HoleRing& b) {
  const double offset = *a.phase - *b.phase, half_period = pi / b.count;
  const double spacing = 2 * pi / static_cast<double>(std::lcm<long long>(a.count, b.count));
  return {std::abs(std::remainder(offset, spacing)),
          half_period - std::abs(std::remainder(half_period - offset, spacing))};
}

bool lies_inside(const HoleRing& a, const HoleRing& b) {
  const double rounding = 1e-9 * b.radius;
  if (std::abs(a.center_radius - b.center_radius) + a.radius > b.radius + rounding) return false;
  return centre_distance(a, b, azimuth_offsets(a, b).minimum) + a.radius <= b.radius + rounding;
}

bool overlaps_everywhere(const HoleRing& a, const HoleRing& b) {
  if (std::abs(a.center_radius - b.center_radius) >= a.radius + b.radius) return false;
  return centre_distance(a, b, azimuth_offsets(a, b).most) < a.radius + b.radius;
}

double smallest_hole_width(const Case& c) {
  std::vector<NamedRing> rings = named_rings(c);
  std::ranges::sort(rings, std::greater{}, [](const NamedRing& named) { return named.ring.radius; });
  std::vector<double> radii;  // of the largest circle known to be part of each hole
  for (const NamedRing& named : rings) {
    double radius = named.ring.radius;
    for (std::size_t j = 0; j < radii.size() && rings.size() <= most_compared; ++j)
      if (radii[j] > radius && overlaps_everywhere(named.ring, rings[j].ring)) radius = radii[j];
    radii.push_back(radius);
  }
  return radii.empty() ? std::numeric_limits<double>::infinity() : 2 * std::ranges::min(radii);
}

}  // namespace wheelwright
