#include "wheelwright/cad/drawing/parts.h"

#include <cmath>
#include <numbers>

#include "wheelwright/cad/drawing/chain.h"

namespace wheelwright {

using std::numbers::pi;

namespace {

DrawnLoop whole_ellipse(const Affine& frame, double half_length, double half_width) {
  std::vector<Curve> quarters;
  for (int i = 0; i < 4; ++i)
    quarters.push_back(
        Curve::arc({}, {half_length, 0}, {0, half_width}, 0.5 * pi * i, 0.5 * pi * (i + 1)).mapped(frame));
  return closed_loop(quarters, "");
}

}  // namespace

Point polar(double radius, double azimuth) {
  return {radius * std::cos(azimuth), radius * std::sin(azimuth)};
}

Affine polar_frame(double radius, double azimuth, double angle) {
  return Affine::shift(polar(radius, azimuth)) * Affine::rotation(azimuth + angle);
}

DrawnOutline circle_outline(const Affine& frame, double radius) {
  return {{whole_ellipse(frame, radius, radius)}};
}

DrawnOutline ellipse_outline(const Affine& frame, double length, double width) {
  return {{whole_ellipse(frame, 0.5 * length, 0.5 * width)}};
}

DrawnOutline slot_outline(const Affine& frame, double length, double width) {
  const double radius = 0.5 * width, half = 0.5 * length - radius;
  if (half <= 0) return circle_outline(frame, radius);
  const std::vector<Curve> curves{Curve::line({-half, -radius}, {half, -radius}),
                                  Curve::circle_arc({half, 0}, radius, -0.5 * pi, 0.5 * pi),
                                  Curve::line({half, radius}, {-half, radius}),
                                  Curve::circle_arc({-half, 0}, radius, 0.5 * pi, 1.5 * pi)};
  std::vector<Curve> placed;
  for (const Curve& curve : curves) placed.push_back(curve.mapped(frame));
  return {{closed_loop(placed, "")}};
}

DrawnOutline polygon_outline(const std::vector<Point>& corners) {
  std::vector<Curve> sides;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sides.push_back(Curve::line(corners[i], corners[(i + 1) % corners.size()]));
  return {{closed_loop(sides, "")}};
}

DrawnOutline annulus_outline(double inner_radius, double outer_radius) {
  return {{whole_ellipse({}, inner_radius, inner_radius), whole_ellipse({}, outer_radius, outer_radius)}};
}

DrawnOutline strip_outline(const Point& from, const Point& to, double thickness, double bend) {
  const Point chord = to - from, across = 1 / norm<2>(chord) * Point{-chord[1], chord[0]};
  const double half = 0.5 * thickness;
  if (bend == 0)
    return polygon_outline(
        {from - half * across, to - half * across, to + half * across, from + half * across});
  // The centre lies to the left of a strip that turns to the left; its radius has the sign of the bend.
  const double radius = 0.5 * norm<2>(chord) / std::sin(0.5 * bend);
  const Point centre = from + 0.5 * chord + radius * std::cos(0.5 * bend) * across;
  const Point out = from - centre;
  const double begin = std::atan2(out[1], out[0]), size = std::abs(radius);
  const Curve outer = Curve::circle_arc(centre, size + half, begin, begin + bend),
              inner = Curve::circle_arc(centre, size - half, begin + bend, begin);
  return {{closed_loop(
      {outer, Curve::line(outer.end(), inner.start()), inner, Curve::line(inner.end(), outer.start())}, "")}};
}

}  // namespace wheelwright
