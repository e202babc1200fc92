#pragma once

#include <vector>

#include "wheelwright/cad/curves/curve.h"

namespace wheelwright {

/// The pieces of a B-spline curve of degree 1 to 3 as exact cubic Bezier curves, of the domain from
/// knots[degree] to knots[n] with n = points.size(). `knots` holds n + degree + 1 numbers that do not
/// decrease.
std::vector<Curve> spline_pieces(int degree, const std::vector<double>& knots,
                                 const std::vector<Point>& points);

/// The same of a rational B-spline, with one weight > 0 for each point. Arcs of ellipses and parabolas, as
/// splines of degree 2 draw circles, are exact; other pieces are cubic Bezier curves that differ from the
/// spline by at most 1e-8 of the size of its control points.
std::vector<Curve> rational_spline_pieces(int degree, const std::vector<double>& knots,
                                          const std::vector<Point>& points,
                                          const std::vector<double>& weights);

}  // namespace wheelwright
