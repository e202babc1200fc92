#include "wheelwright/cad/curves/spline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "wheelwright/cad/curves/blossom.h"

namespace wheelwright {

namespace {

/// The point (x, y) with weight w is (w x, w y, w).
using Homogeneous = Vec<3>;

/// The control points of the Bezier pieces of a B-spline, one piece for each span that is not empty.
template <int n>
std::vector<std::vector<Vec<n>>> bezier_points(int degree, const std::vector<double>& knots,
                                               const std::vector<Vec<n>>& points) {
  std::vector<std::vector<Vec<n>>> pieces;
  for (int span = degree; span < static_cast<int>(points.size()); ++span) {
    const double low = knots[span], high = knots[span + 1];
    if (!(low < high)) continue;
    const std::span around(&knots[span - degree + 1], 2 * degree);
    std::vector<Vec<n>> control;
    for (int j = 0; j <= degree; ++j) {
      std::vector<double> arguments(degree, low);
      for (int i = 0; i < j; ++i) arguments[degree - 1 - i] = high;
      control.push_back(blossom(std::vector(points.begin() + (span - degree), points.begin() + span + 1),
                                around, arguments));
    }
    if (!pieces.empty()) control.front() = pieces.back().back();
    pieces.push_back(std::move(control));
  }
  return pieces;
}

/// The conic of three control points with the weights 1, w, 1, if it is a parabola or the arc of an ellipse.
std::optional<Curve> conic(const Point& p0, const Point& p1, const Point& p2, double w) {
  constexpr double rounding = 1e-9;
  if (std::abs(w - 1) < rounding) return Curve::quadratic(p0, p1, p2);
  if (w > 1) return {};
  const double half_angle = std::acos(w);
  const Point shoulder = 1 / (1 + w) * (0.5 * (p0 + p2) + w * p1);
  const Point centre = 1 / (2 * (1 - w * w)) * (p0 + p2 - 2 * w * w * p1);
  return Curve::arc(centre, shoulder - centre, 0.5 / std::sin(half_angle) * (p2 - p0), -half_angle,
                    half_angle)
      .with_ends(p0, p2);
}

/// A rational Bezier curve of degree 1 to 3.
class RationalPiece {
 public:
  explicit RationalPiece(const std::vector<Homogeneous>& control) : control_(control) {}

  /// Appends cubic curves that differ from it by at most the tolerance.
  void append_cubics(double tolerance, std::vector<Curve>& curves) const {
    append_cubics({0, point(control_.front())}, {1, point(control_.back())}, tolerance, 0, curves);
  }

  Point at(double s) const { return point(values(s)[0]); }

 private:
  struct Place {
    double parameter;
    Point at;
  };

  static Point point(const Homogeneous& h) { return {h[0] / h[2], h[1] / h[2]}; }

  /// Value and derivative, by de Casteljau's algorithm.
  std::array<Homogeneous, 2> values(double s) const {
    std::vector<Homogeneous> d = control_;
    Homogeneous derivative{};
    const auto degree = static_cast<double>(d.size() - 1);
    for (; d.size() > 1; d.pop_back()) {
      if (d.size() == 2) derivative = degree * (d[1] - d[0]);
      for (std::size_t i = 0; i + 1 < d.size(); ++i) d[i] = (1 - s) * d[i] + s * d[i + 1];
    }
    return {d[0], derivative};
  }

  Point derivative(double s) const {
    const auto [h, dh] = values(s);
    const Point x = point(h);
    return {(dh[0] - x[0] * dh[2]) / h[2], (dh[1] - x[1] * dh[2]) / h[2]};
  }

  void append_cubics(const Place& from, const Place& to, double tolerance, int depth,
                     std::vector<Curve>& curves) const {
    constexpr int deepest = 9;
    const double length = to.parameter - from.parameter;
    const Curve cubic = Curve::cubic(from.at, from.at + length / 3 * derivative(from.parameter),
                                     to.at - length / 3 * derivative(to.parameter), to.at);
    const auto is_near = [&](double s) {
      return !(distance(cubic.at(s), at(from.parameter + s * length)) > tolerance);
    };
    if (depth == deepest || (is_near(0.25) && is_near(0.5) && is_near(0.75))) {
      curves.push_back(cubic);
      return;
    }
    const double middle = from.parameter + 0.5 * length;
    const Place between{middle, at(middle)};
    append_cubics(from, between, tolerance, depth + 1, curves);
    append_cubics(between, to, tolerance, depth + 1, curves);
  }

  std::vector<Homogeneous> control_;
};

}  // namespace

std::vector<Curve> spline_pieces(int degree, const std::vector<double>& knots,
                                 const std::vector<Point>& points) {
  std::vector<Curve> pieces;
  for (const auto& control : bezier_points<2>(degree, knots, points))
    pieces.push_back(degree == 1   ? Curve::line(control[0], control[1])
                     : degree == 2 ? Curve::quadratic(control[0], control[1], control[2])
                                   : Curve::cubic(control[0], control[1], control[2], control[3]));
  return pieces;
}

std::vector<Curve> rational_spline_pieces(int degree, const std::vector<double>& knots,
                                          const std::vector<Point>& points,
                                          const std::vector<double>& weights) {
  constexpr double relative_tolerance = 1e-8;
  std::vector<Homogeneous> homogeneous;
  Box box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    homogeneous.push_back({weights[i] * points[i][0], weights[i] * points[i][1], weights[i]});
    box.add(points[i]);
  }
  std::vector<Curve> pieces;
  for (const auto& control : bezier_points<3>(degree, knots, homogeneous)) {
    std::vector<Point> p;
    for (const Homogeneous& h : control) p.push_back({h[0] / h[2], h[1] / h[2]});
    const auto arc = degree == 2
                         ? conic(p[0], p[1], p[2], control[1][2] / std::sqrt(control[0][2] * control[2][2]))
                         : std::nullopt;
    if (arc)
      pieces.push_back(*arc);
    else if (degree == 1)
      pieces.push_back(Curve::line(p[0], p[1]));
    else
      RationalPiece(control).append_cubics(relative_tolerance * box.size(), pieces);
  }
  return pieces;
}

}  // namespace wheelwright
