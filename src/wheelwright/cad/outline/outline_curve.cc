#include "wheelwright/cad/outline/outline_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "wheelwright/cad/curves/blossom.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright::cad {
namespace {

Vec<2> on_circle(const Arc& arc, double azimuth) {
  return arc.centre + arc.radius * Vec<2>{std::cos(azimuth), std::sin(azimuth)};
}

int n_spans(const Spline& spline) { return static_cast<int>(spline.points.size()) - Spline::degree; }

Bezier bezier_of_span(const Spline& spline, int span) {
  Bezier points;
  std::copy_n(spline.points.begin() + span, Spline::degree + 1, points.begin());
  const std::span knots(&spline.knots[span + 1], 2 * Spline::degree);
  const double a = knots[Spline::degree - 1], b = knots[Spline::degree];
  const auto point = [&](std::array<double, Spline::degree> arguments) {
    return blossom(points, knots, arguments);
  };
  return {point({a, a, a}), point({a, a, b}), point({a, b, b}), point({b, b, b})};
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
    return on_circle(arc, azimuth) + length * Vec<2>{-std::sin(azimuth), std::cos(azimuth)};
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
    return {between(line->start, line->end, parameter), line->end - line->start};
  if (const auto* arc = std::get_if<Arc>(&curve)) {
    const double azimuth = arc->begin + parameter * arc->sweep;
    return {on_circle(*arc, azimuth),
            {-arc->sweep * arc->radius * std::sin(azimuth), arc->sweep * arc->radius * std::cos(azimuth)}};
  }
  const Spline& spline = std::get<Spline>(curve);
  const double whole = spline.knots.back() - spline.knots.front();
  const double u = spline.knots.front() + parameter * whole;
  const auto first = spline.knots.begin() + Spline::degree, last = spline.knots.end() - Spline::degree - 1;
  const auto above = std::upper_bound(first + 1, last, u);
  const int span = static_cast<int>(above - first) - 1;
  const double low = *(above - 1), length = *above - low;
  const auto [position, velocity] = wheelwright::at(bezier_of_span(spline, span), (u - low) / length);
  return {position, whole / length * velocity};
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
  const auto turn = [angle](const Vec<2>& p) { return wheelwright::rotated<2>(p, angle); };
  if (const auto* line = std::get_if<Line>(&curve)) return Line{turn(line->start), turn(line->end)};
  if (const auto* arc = std::get_if<Arc>(&curve))
    return Arc{turn(arc->centre), arc->radius, arc->begin + angle, arc->sweep};
  Spline spline = std::get<Spline>(curve);
  std::ranges::transform(spline.points, spline.points.begin(), turn);
  return spline;
}

Curve mirrored(const Curve& curve, double middle) {
  const auto image = [middle](const Vec<2>& p) { return Vec<2>{2 * middle - p[0], p[1]}; };
  if (const auto* line = std::get_if<Line>(&curve)) return Line{image(line->start), image(line->end)};
  if (const auto* arc = std::get_if<Arc>(&curve))
    return Arc{image(arc->centre), arc->radius, std::numbers::pi - arc->begin, -arc->sweep};
  Spline spline = std::get<Spline>(curve);
  std::ranges::transform(spline.points, spline.points.begin(), image);
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
    return 0.5 * (arc->radius * arc->radius * arc->sweep + cross(arc->centre, b - a));
  }
  double sum = 0;
  for (const Bezier& piece : beziers_of(std::get<Spline>(curve))) sum += wheelwright::area_under(piece);
  return sum;
}

std::vector<Bezier> beziers(const Curve& curve, double tolerance) {
  if (const auto* line = std::get_if<Line>(&curve)) return beziers_of(*line);
  if (const auto* arc = std::get_if<Arc>(&curve)) return beziers_of(*arc, tolerance);
  return beziers_of(std::get<Spline>(curve));
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
      const int n = wheelwright::n_chords(piece, tolerance);
      for (int i = 0; i < n; ++i)
        points.push_back(wheelwright::at(piece, static_cast<double>(i) / n).position);
    }
  }
  return points;
}

}  // namespace wheelwright::cad
