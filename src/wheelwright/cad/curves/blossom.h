#pragma once

#include <span>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// The blossom of a polynomial span of a B-spline, by de Boor's algorithm: symmetric, affine in each
/// argument, and equal to the spline where all arguments are. There are as many arguments as the degree.
/// `points` are the degree + 1 control points of the span, `knots` the `degree` knots up to its begin and the
/// `degree` knots from its end on.
template <class Points>
auto blossom(Points points, std::span<const double> knots, std::span<const double> arguments) {
  const int degree = static_cast<int>(arguments.size());
  for (int level = 1; level <= degree; ++level)
    for (int i = degree; i >= level; --i) {
      const double low = knots[i - 1], high = knots[degree + i - level];
      points[i] = between(points[i - 1], points[i], (arguments[level - 1] - low) / (high - low));
    }
  return points[degree];
}

}  // namespace wheelwright
