#pragma once

#include <span>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// The smallest ball that contains some points of R^5.
class SmallestBall {
 public:
  using Point = Vec<5>;

  /// Of at least one point.
  explicit SmallestBall(std::span<const Point> points);

  const Point& center() const { return center_; }
  double radius() const { return radius_; }

 private:
  Point center_{};
  double radius_ = 0;
};

}  // namespace wheelwright
