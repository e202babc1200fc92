#pragma once

#include <numbers>

namespace wheelwright {

/// Area of a disk, or volume of a ball when dim = 3.
template <int dim>
double ball_measure(double radius) {
  constexpr double pi = std::numbers::pi;
  return dim == 2 ? pi * radius * radius : 4 * pi / 3 * radius * radius * radius;
}

/// Length of a circle, or area of a sphere when dim = 3.
template <int dim>
double sphere_measure(double radius) {
  constexpr double pi = std::numbers::pi;
  return dim == 2 ? 2 * pi * radius : 4 * pi * radius * radius;
}

}  // namespace wheelwright
