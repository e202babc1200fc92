#include "wheelwright/drawing/spline.h"

namespace wheelwright {

namespace {

/// The polar form (blossom) of the polynomial on the span from knots[span] at `arguments`, by de Boor's
/// algorithm.
Point blossom(int degree, const std::vector<double>& knots, const std::vector<Point>& points, int span,
              const std::vector<double>& arguments) {
  std::vector<Point> d(points.begin() + (span - degree), points.begin() + span + 1);
  for (int level = 1; level <= degree; ++level)
    for (int i = degree; i >= level; --i) {
      const double low = knots[span - degree + i], high = knots[i + span + 1 - level];
      const double share = (arguments[level - 1] - low) / (high - low);
      d[i] = (1 - share) * d[i - 1] + share * d[i];
    }
  return d[degree];
}

}  // namespace

std::vector<Curve> spline_pieces(int degree, const std::vector<double>& knots,
                                 const std::vector<Point>& points) {
  std::vector<Curve> pieces;
  const int n = static_cast<int>(points.size());
  for (int span = degree; span < n; ++span) {
    const double low = knots[span], high = knots[span + 1];
    if (!(low < high)) continue;
    std::vector<Point> control;
    for (int j = 0; j <= degree; ++j) {
      std::vector<double> arguments(degree, low);
      for (int i = 0; i < j; ++i) arguments[degree - 1 - i] = high;
      control.push_back(blossom(degree, knots, points, span, arguments));
    }
    if (!pieces.empty()) control.front() = pieces.back().end();
    pieces.push_back(degree == 1   ? Curve::line(control[0], control[1])
                     : degree == 2 ? Curve::quadratic(control[0], control[1], control[2])
                                   : Curve::cubic(control[0], control[1], control[2], control[3]));
  }
  return pieces;
}

}  // namespace wheelwright
