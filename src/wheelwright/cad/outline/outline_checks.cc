#include "wheelwright/cad/outline/outline_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/cad/outline/triangulation.h"
#include "wheelwright/shape/geometry/nearest_point.h"

namespace wheelwright::cad {

void check_closed(const Outline& outline, double slack, PlaceText place, Faults& faults) {
  for (const Loop& loop : outline.loops) {
    const Curve* before = &loop.curves.back();
    for (const Curve& curve : loop.curves) {
      if (const double miss = distance(end_of(*before), start_of(curve)); !(miss <= slack))
        faults.push_back({fmt::format("the {} is open by {:.3g} mm at {}", name(loop.kind), miss * 1e3,
                                      place(start_of(curve)))});
      before = &curve;
    }
  }
}

void check_side(LoopKind kind, const Curve& curve, const ZeroSet& zero, double tolerance, PlaceText place,
                Faults& faults) {
  constexpr double parameter = 0.5, distance_in_tolerances = 3;
  const CurvePoint middle = at(curve, parameter);
  const double scale = distance_in_tolerances * tolerance / norm(middle.velocity);
  const Vec<2> left = scale * left_of(middle.velocity);
  const auto psi = [&](double side) { return zero.at(middle.position + side * left).psi; };
  if (!(psi(1) < psi(-1)))
    faults.push_back(
        {fmt::format("the material is not on the left of the {} at {}", name(kind), place(middle.position))});
}

void check_crossings(const std::vector<Polygon>& polygons, PlaceText place, Faults& faults) {
  constexpr std::size_t max_shown = 10;
  const auto places = crossings(polygons);
  for (std::size_t i = 0; i < std::min(places.size(), max_shown); ++i)
    faults.push_back({"edges cross or touch at " + place(places[i])});
  if (places.size() > max_shown)
    faults.push_back({fmt::format("edges cross or touch at {} more places", places.size() - max_shown)});
}

Deviation deviation_of(const Curve& curve, const ZeroSet& zero) {
  constexpr int points_per_cubic = 16;
  Deviation deviation;
  const auto* spline = std::get_if<Spline>(&curve);
  const int n = points_per_cubic * (spline ? static_cast<int>(spline->points.size()) : 8);
  for (int i = 0; i <= n; ++i) {
    const Vec<2> p = at(curve, static_cast<double>(i) / n).position;
    const auto q = zero.projection(p);
    deviation.include(q ? distance(p, *q) : INFINITY, p);
  }
  return deviation;
}

namespace {

/// Polygons with corners at most `step` apart, and the corners' neighbours.
struct DenseCorners {
  std::vector<Vec<2>> points;
  std::vector<int> before, after;

  DenseCorners(const std::vector<Polygon>& polygons, double step) {
    for (const Polygon& polygon : polygons) {
      const int first = static_cast<int>(points.size());
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const int parts = std::max(1, static_cast<int>(std::ceil(distance(a, b) / step)));
        for (int k = 0; k < parts; ++k) points.push_back(a + static_cast<double>(k) * (b - a) / parts);
      }
      const int end = static_cast<int>(points.size());
      for (int i = first; i < end; ++i) {
        before.push_back(i == first ? end - 1 : i - 1);
        after.push_back(i + 1 == end ? first : i + 1);
      }
    }
  }
};

}  // namespace

Deviation deviation_of(std::span<const Vec<2>> points, const std::vector<Polygon>& polygons, double step) {
  const DenseCorners dense(polygons, step);
  const NearestPoint<2> nearest(dense.points);
  Deviation deviation;
  for (const Vec<2>& p : points) {
    const int corner = nearest.index_of_nearest(p);
    const Vec<2>& q = dense.points[corner];
    deviation.include(std::min(distance_to_segment(p, dense.points[dense.before[corner]], q),
                               distance_to_segment(p, q, dense.points[dense.after[corner]])),
                      p);
  }
  return deviation;
}

void check_deviation(const Deviation& deviation, double tolerance, PlaceText place, Faults& faults) {
  if (!(deviation.distance <= tolerance))
    faults.push_back(
        {fmt::format("curve and contour are {:.4g} mm apart at {}, more than the tolerance of {:.4g} mm",
                     deviation.distance * 1e3, place(deviation.place), tolerance * 1e3)});
}

}  // namespace wheelwright::cad
