#pragma once

#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/outline_curve.h"

namespace wheelwright::cad {

/// Points that no spline follows within the tolerance.
struct NoFit {
  Vec<2> place;      ///< where the deviation is largest
  double deviation;  ///< there [m]
};

/// Minimum number of points per knot interval of a fit.
inline constexpr int samples_per_interval = 4;

/// A spline with few knots that passes all points, which are about equally spaced, within `tolerance` [m]. An
/// open one starts at the first point and ends at the last; a closed one has continuous curvature where it
/// closes, too, and `points` does not repeat its first point.
Expected<Spline, NoFit> fit_spline(std::span<const Vec<2>> points, bool closed, double tolerance);

}  // namespace wheelwright::cad
