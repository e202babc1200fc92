#pragma once

#include <array>
#include <span>
#include <vector>

#include "wheelwright/mechanics/elasticity/smallest_ball.h"

namespace wheelwright {

/// A ball around points of R^5 that depends smoothly on them, unlike the smallest one: its center c minimizes
/// the norm (sum_j |x_j - c|^64)^(1/64), which is its radius, at most n^(1/64) times that of the smallest
/// ball of n points.
class SmoothBall {
 public:
  using Point = SmallestBall::Point;
  static constexpr int exponent = 64;

  /// `smallest`: that of the points.
  SmoothBall(std::span<const Point> points, const SmallestBall& smallest);

  const Point& center() const { return center_; }
  double radius() const { return radius_; }

  /// The derivative of the radius with respect to every point.
  std::vector<Point> slopes_of_radius() const;
  /// That of a . center.
  std::vector<Point> slopes_of_center(const Point& a) const;

 private:
  std::vector<Point> from_center_;  ///< x_j - c, by the radius of the smallest ball
  Point center_{};
  double radius_, smallest_radius_;
  std::array<Vec<5>, 5> second_{};  ///< derivative of the sum of powers, by that radius; its lower triangle
};

}  // namespace wheelwright
