#pragma once

#include "wheelwright/base/vec.h"

namespace wheelwright {

using Point = Vec<2>;

/// The map x -> (xx x + xy y + dx, yx x + yy y + dy) of the plane.
struct Affine {
  double xx = 1, xy = 0, yx = 0, yy = 1, dx = 0, dy = 0;

  static Affine shift(const Point& by) { return {.dx = by[0], .dy = by[1]}; }
  static Affine scaling(double x, double y) { return {.xx = x, .yy = y}; }
  /// Towards larger azimuth [rad].
  static Affine rotation(double angle) {
    return {.xx = std::cos(angle), .xy = -std::sin(angle), .yx = std::sin(angle), .yy = std::cos(angle)};
  }

  Point linear(const Point& v) const { return {xx * v[0] + xy * v[1], yx * v[0] + yy * v[1]}; }
  Point operator()(const Point& p) const { return linear(p) + Point{dx, dy}; }
};

/// First `inner`, then `outer`.
inline Affine operator*(const Affine& outer, const Affine& inner) {
  const Point x = outer.linear({inner.xx, inner.yx}), y = outer.linear({inner.xy, inner.yy}),
              d = outer({inner.dx, inner.dy});
  return {x[0], y[0], x[1], y[1], d[0], d[1]};
}

}  // namespace wheelwright
