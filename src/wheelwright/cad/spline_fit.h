#pragma once

#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/curve.h"

namespace wheelwright {

/// Points that no spline follows within the tolerance.
struct NoFit {
  Vec<2> place;      ///< where the deviation is largest
  double deviation;  ///< there [m]
};

/// The smoothest chain of points that a fit may follow: at least so many per interval of knots.
inline constexpr int samples_per_interval = 4;

/// A spline with few knots that passes all points, which follow each other at about equal distances, within
/// `tolerance` [m]. An open one begins at the first point and ends at the last; a closed one has continuous
/// curvature where it closes, too, and `points` does not repeat its first point.
Expected<Spline, NoFit> fit_spline(std::span<const Vec<2>> points, bool closed, double tolerance);

}  // namespace wheelwright
