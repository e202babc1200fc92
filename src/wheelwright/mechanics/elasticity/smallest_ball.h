#pragma once

#include <array>
#include <span>
#include <vector>

namespace wheelwright {

/// The smallest ball that contains some points of R^5, and how it changes with them.
class SmallestBall {
 public:
  using Point = std::array<double, 5>;

  /// Of at least one point.
  explicit SmallestBall(std::span<const Point> points);

  const Point& center() const { return center_; }
  double radius() const { return radius_; }

  /// A derivative with respect to one of the points, given by its place among them.
  struct Slope {
    int point;
    Point by_coordinates;
  };
  /// Those of the radius; none if it is 0.
  std::vector<Slope> slopes_of_radius() const;
  /// Those of a . center.
  std::vector<Slope> slopes_of_center(const Point& a) const;

 private:
  Point center_{};
  double radius_ = 0;
  // The points on the sphere that determine it, affinely independent, and the weights of their mean, the
  // center.
  std::vector<int> support_;
  std::vector<Point> places_;
  std::vector<double> weights_;
};

}  // namespace wheelwright
