#pragma once

#include <vector>

#include "wheelwright/drawing/curve.h"

namespace wheelwright {

/// The pieces of a B-spline curve of degree 1 to 3 as exact cubic Bezier curves, of the domain from
/// knots[degree] to knots[n] with n = points.size(). `knots` holds n + degree + 1 numbers that do not
/// decrease.
std::vector<Curve> spline_pieces(int degree, const std::vector<double>& knots,
                                 const std::vector<Point>& points);

}  // namespace wheelwright
