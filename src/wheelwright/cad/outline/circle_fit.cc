#include "wheelwright/cad/outline/circle_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/linalg/dense.h"

namespace wheelwright::cad {
namespace {

bool all_on(const Arc& circle, std::span<const Vec<2>> points, double tolerance) {
  return std::ranges::all_of(points, [&](const Vec<2>& p) {
    return std::abs(norm(p - circle.centre) - circle.radius) <= tolerance;
  });
}

/// Sweep of the points about a centre [rad], positive counter-clockwise.
double sweep_about(const Vec<2>& centre, std::span<const Vec<2>> points) {
  double sweep = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec<2> a = points[i - 1] - centre, b = points[i] - centre;
    sweep += std::atan2(cross(a, b), dot(a, b));
  }
  return sweep;
}

}  // namespace

std::optional<Line> fit_line(std::span<const Vec<2>> points, double tolerance) {
  const Vec<2> along = points.back() - points.front();
  const double length = norm(along);
  if (length <= tolerance) return {};
  for (const Vec<2>& p : points) {
    const Vec<2> from_start = p - points.front();
    if (std::abs(cross(along, from_start)) > tolerance * length) return {};
    if (const double s = dot(along, from_start); s < 0 || s > length * length) return {};
  }
  return Line{points.front(), points.back()};
}

std::optional<Arc> fit_arc(std::span<const Vec<2>> points, double tolerance) {
  // The centre is c = m + h n, with the middle m and the normal n of the chord: for a point p of the circle
  // 2 h (p - m).n = |p - m|^2 - (half the chord)^2.
  const Vec<2> a = points.front(), b = points.back(), chord = b - a;
  const double length = norm(chord);
  const Vec<2> middle = (a + b) / 2, normal = left_of(chord) / length;
  double numerator = 0, denominator = 0;
  for (const Vec<2>& p : points) {
    const Vec<2> d = p - middle;
    const double across = 2 * dot(d, normal);
    numerator += across * (dot(d, d) - length * length / 4);
    denominator += across * across;
  }
  const double h = numerator / denominator;
  if (!std::isfinite(h)) return {};
  Arc arc{middle + h * normal, std::hypot(h, length / 2), 0, 0};
  if (!all_on(arc, points, tolerance)) return {};
  arc.begin = std::atan2(a[1] - arc.centre[1], a[0] - arc.centre[0]);
  arc.sweep = sweep_about(arc.centre, points);
  if (std::abs(arc.sweep) >= 2 * std::numbers::pi) return {};
  return arc;
}

std::optional<Arc> fit_circle(std::span<const Vec<2>> points, double tolerance) {
  // The least squares of |p|^2 - 2 c.p - (r^2 - |c|^2), about the first point.
  Matrix normal(3, 3), right(3, 1);
  const Vec<2> origin = points.front();
  for (const Vec<2>& point : points) {
    const Vec<2> p = point - origin;
    const Vec<3> row{2 * p[0], 2 * p[1], 1};
    for (int i = 0; i < 3; ++i) {
      right(i, 0) += row[i] * dot(p, p);
      for (int j = 0; j < 3; ++j) normal(i, j) += row[i] * row[j];
    }
  }
  if (!lu_solve(normal, right)) return {};
  const Vec<2> c{right(0, 0), right(1, 0)};
  Arc circle{c + origin, std::sqrt(right(2, 0) + dot(c, c)), 0, 0};
  if (!std::isfinite(circle.radius) || !all_on(circle, points, tolerance)) return {};
  const double sweep = sweep_about(circle.centre, points);
  circle.begin = std::atan2(origin[1] - circle.centre[1], origin[0] - circle.centre[0]);
  circle.sweep = std::copysign(2 * std::numbers::pi, sweep);
  return circle;
}

}  // namespace wheelwright::cad
