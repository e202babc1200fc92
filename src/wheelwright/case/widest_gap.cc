#include "wheelwright/case/widest_gap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/drawing/composition.h"
#include "wheelwright/case/drawn_shapes.h"

namespace wheelwright {

WidestGap widest_gap(const Case& c) {
  constexpr int along_radius = 80, most_along_azimuth = 400;
  const double inner = c.wheel.inner_radius, ring = c.wheel.outer_radius - inner;
  const double sector = 2 * std::numbers::pi / c.wheel.sectors, step = ring / along_radius;
  const int along_azimuth =
      std::clamp(static_cast<int>(sector * c.wheel.outer_radius / step) + 1, 1, most_along_azimuth);
  const double across = sector * c.wheel.outer_radius / along_azimuth;
  const Composition shapes(figures(c));
  double largest = 0;
  for (int i = 0; i <= along_radius; ++i)
    for (int j = 0; j < along_azimuth; ++j) {
      const double radius = inner + i * step, azimuth = j * sector / along_azimuth;
      const Point x{radius * std::cos(azimuth), radius * std::sin(azimuth)};
      if (shapes.is_hole(x)) largest = std::max(largest, 2 * shapes.distance(x, ring));
    }
  // The centre of the largest circle is at most half a step from a point.
  return {.diameter = largest, .at_most = largest + std::hypot(step, across)};
}

}  // namespace wheelwright
