#include "wheelwright/cad/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "wheelwright/geometry/cell_map.h"

namespace wheelwright {
namespace {

constexpr int degree = 3;

Vec<2> between(const Vec<2>& a, const Vec<2>& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

Vec<2> on_circle(const Arc& arc, double azimuth) {
  return {arc.centre[0] + arc.radius * std::cos(azimuth), arc.centre[1] + arc.radius * std::sin(azimuth)};
}

double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The blossom of the polynomial in the span [knots[k], knots[k + 1]): symmetric, affine in each argument,
/// and equal to the spline where all arguments are.
Vec<2> blossom(const Spline& spline, int k, std::array<double, degree> arguments) {
  std::array<Vec<2>, degree + 1> d;
  for (int i = 0; i <= degree; ++i) d[i] = spline.points[k - degree + i];
  for (int level = 1; level <= degree; ++level)
    for (int i = degree; i >= level; --i) {
      const double low = spline.knots[k - degree + i], high = spline.knots[k + i + 1 - level];
      d[i] = between(d[i - 1], d[i], (arguments[level - 1] - low) / (high - low));
    }
  return d[degree];
}

int n_spans(const Spline& spline) { return static_cast<int>(spline.points.size()) - degree; }

Bezier bezier_of_span(const Spline& spline, int span) {
  const int k = span + degree;
  const double a = spline.knots[k], b = spline.knots[k + 1];
  return {blossom(spline, k, {a, a, a}), blossom(spline, k, {a, a, b}), blossom(spline, k, {a, b, b}),
          blossom(spline, k, {b, b, b})};
}

CurvePoint at(const Bezier& p, double t) {
  const auto level = [t](const auto& points) {
    std::array<Vec<2>, std::tuple_size_v<std::remove_cvref_t<decltype(points)>> - 1> result;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = between(points[i], points[i + 1], t);
    return result;
  };
  const auto line = level(level(p));
  return {between(line[0], line[1], t),
          {degree * (line[1][0] - line[0][0]), degree * (line[1][1] - line[0][1])}};
}

double area_under(const Bezier& p) {
  // The integrals of the products of the Bernstein polynomials and their derivatives, times 10.
  return (6 * cross(p[0], p[1]) + 3 * cross(p[0], p[2]) + cross(p[0], p[3]) + 3 * cross(p[1], p[2]) +
          3 * cross(p[1], p[3]) + 6 * cross(p[2], p[3])) /
         20;
}

/// Number of equal parts of an arc whose chords deviate by at most `tolerance`.
int n_chords(const Arc& arc, double tolerance) {
  const double angle = 2 * std::acos(std::max(0.0, 1 - tolerance / arc.radius));
  const int fewest = is_circle(arc) ? 3 : 1;
  return std::max(fewest, static_cast<int>(std::ceil(std::abs(arc.sweep) / angle)));
}

/// The cubic that meets an arc at its ends and middle, with its tangents at the ends.
Bezier bezier_of_arc(const Arc& arc, double begin, double sweep) {
  const double handle = 4.0 / 3 * std::tan(sweep / 4) * arc.radius;
  const auto along = [&](double azimuth, double length) {
    const Vec<2> p = on_circle(arc, azimuth);
    return Vec<2>{p[0] - length * std::sin(azimuth), p[1] + length * std::cos(azimuth)};
  };
  return {on_circle(arc, begin), along(begin, handle), along(begin + sweep, -handle),
          on_circle(arc, begin + sweep)};
}

std::vector<Bezier> beziers_of(const Line& line) {
  return {
      {line.start, between(line.start, line.end, 1.0 / 3), between(line.start, line.end, 2.0 / 3), line.end}};
}

std::vector<Bezier> beziers_of(const Arc& arc, double tolerance) {
  // The radial error over the radius is 2/27 sin(part / 4)^6 / cos(part / 4)^2.
  constexpr double largest_part = std::numbers::pi / 2;
  const double cosine = std::cos(largest_part / 4);
  const double part = 4 * std::pow(13.5 * cosine * cosine * tolerance / arc.radius, 1.0 / 6);
  const int n = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / std::min(part, largest_part))));
  std::vector<Bezier> result;
  for (int i = 0; i < n; ++i)
    result.push_back(bezier_of_arc(arc, arc.begin + i * arc.sweep / n, arc.sweep / n));
  return result;
}

std::vector<Bezier> beziers_of(const Spline& spline) {
  std::vector<Bezier> result;
  for (int span = 0; span < n_spans(spline); ++span) result.push_back(bezier_of_span(spline, span));
  return result;
}

}  // namespace

CurvePoint at(const Curve& curve, double parameter) {
  if (const auto* line = std::get_if<Line>(&curve))
    return {between(line->start, line->end, parameter),
            {line->end[0] - line->start[0], line->end[1] - line->start[1]}};
  if (const auto* arc = std::get_if<Arc>(&curve)) {
    const double azimuth = arc->begin + parameter * arc->sweep;
    return {on_circle(*arc, azimuth),
            {-arc->sweep * arc->radius * std::sin(azimuth), arc->sweep * arc->radius * std::cos(azimuth)}};
  }
  const Spline& spline = std::get<Spline>(curve);
  const double whole = spline.knots.back() - spline.knots.front();
  const double u = spline.knots.front() + parameter * whole;
  const auto first = spline.knots.begin() + degree, last = spline.knots.end() - degree - 1;
  const auto above = std::upper_bound(first + 1, last, u);
  const int span = static_cast<int>(above - first) - 1;
  const double low = *(above - 1), length = *above - low;
  CurvePoint point = at(bezier_of_span(spline, span), (u - low) / length);
  for (double& v : point.velocity) v *= whole / length;
  return point;
}

Vec<2> start_of(const Curve& curve) {
  if (const auto* spline = std::get_if<Spline>(&curve)) return spline->points.front();
  return at(curve, 0).position;
}

Vec<2> end_of(const Curve& curve) {
  if (const auto* spline = std::get_if<Spline>(&curve)) return spline->points.back();
  if (is_circle(curve)) return start_of(curve);
  return at(curve, 1).position;
}

bool is_circle(const Curve& curve) {
  const auto* arc = std::get_if<Arc>(&curve);
  return arc && std::abs(arc->sweep) == 2 * std::numbers::pi;
}

Curve rotated(const Curve& curve, double angle) {
  const auto turn = [angle](const Vec<2>& p) { return rotated<2>(p, angle); };
  if (const auto* line = std::get_if<Line>(&curve)) return Line{turn(line->start), turn(line->end)};
  if (const auto* arc = std::get_if<Arc>(&curve))
    return Arc{turn(arc->centre), arc->radius, arc->begin + angle, arc->sweep};
  Spline spline = std::get<Spline>(curve);
  std::ranges::transform(spline.points, spline.points.begin(), turn);
  return spline;
}

Curve reversed(const Curve& curve) {
  if (const auto* line = std::get_if<Line>(&curve)) return Line{line->end, line->start};
  if (const auto* arc = std::get_if<Arc>(&curve))
    return Arc{arc->centre, arc->radius, arc->begin + arc->sweep, -arc->sweep};
  Spline spline = std::get<Spline>(curve);
  std::ranges::reverse(spline.points);
  const double sum = spline.knots.front() + spline.knots.back();
  std::ranges::reverse(spline.knots);
  for (double& knot : spline.knots) knot = sum - knot;
  return spline;
}

double area_under(const Curve& curve) {
  if (const auto* line = std::get_if<Line>(&curve)) return 0.5 * cross(line->start, line->end);
  if (const auto* arc = std::get_if<Arc>(&curve)) {
    const Vec<2> a = start_of(curve), b = end_of(curve);
    return 0.5 * (arc->radius * arc->radius * arc->sweep + cross(arc->centre, {b[0] - a[0], b[1] - a[1]}));
  }
  double sum = 0;
  for (const Bezier& piece : beziers_of(std::get<Spline>(curve))) sum += area_under(piece);
  return sum;
}

std::vector<Bezier> beziers(const Curve& curve, double tolerance) {
  if (const auto* line = std::get_if<Line>(&curve)) return beziers_of(*line);
  if (const auto* arc = std::get_if<Arc>(&curve)) return beziers_of(*arc, tolerance);
  return beziers_of(std::get<Spline>(curve));
}

int n_chords(const Bezier& p, double tolerance) {
  double second = 0;  // bound of the second derivative
  for (int i = 0; i < 2; ++i)
    second = std::max(second, 6 * std::hypot(p[i][0] - 2 * p[i + 1][0] + p[i + 2][0],
                                             p[i][1] - 2 * p[i + 1][1] + p[i + 2][1]));
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(second / (8 * tolerance)))));
}

std::vector<Bezier> divided(const Bezier& cubic, int parts) {
  std::vector<Bezier> result;
  for (int i = 0; i < parts; ++i) {
    const CurvePoint a = at(cubic, static_cast<double>(i) / parts),
                     b = at(cubic, static_cast<double>(i + 1) / parts);
    const double third = 1.0 / (degree * parts);
    result.push_back({a.position,
                      {a.position[0] + third * a.velocity[0], a.position[1] + third * a.velocity[1]},
                      {b.position[0] - third * b.velocity[0], b.position[1] - third * b.velocity[1]},
                      b.position});
  }
  return result;
}

std::vector<Vec<2>> flattened(const Curve& curve, double tolerance) {
  std::vector<Vec<2>> points;
  if (const auto* line = std::get_if<Line>(&curve)) {
    points.push_back(line->start);
  } else if (const auto* arc = std::get_if<Arc>(&curve)) {
    const int n = n_chords(*arc, tolerance);
    for (int i = 0; i < n; ++i) points.push_back(on_circle(*arc, arc->begin + i * arc->sweep / n));
  } else {
    for (const Bezier& piece : beziers_of(std::get<Spline>(curve))) {
      const int n = n_chords(piece, tolerance);
      for (int i = 0; i < n; ++i) points.push_back(at(piece, static_cast<double>(i) / n).position);
    }
  }
  return points;
}

}  // namespace wheelwright
