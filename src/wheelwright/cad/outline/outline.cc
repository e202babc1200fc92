#include "wheelwright/cad/outline/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wheelwright/shape/geometry/place.h"

namespace wheelwright::cad {

const char* name(LoopKind kind) {
  switch (kind) {
    case LoopKind::outer_edge:
      return "outer_edge";
    case LoopKind::bore:
      return "bore";
    case LoopKind::hole:
      return "hole";
    case LoopKind::island:
      return "island";
  }
  return "loop";
}

double signed_area(const Loop& loop) {
  return std::accumulate(loop.curves.begin(), loop.curves.end(), 0.0,
                         [](double sum, const Curve& curve) { return sum + area_under(curve); });
}

double material_area(const Outline& outline) {
  return std::accumulate(outline.loops.begin(), outline.loops.end(), 0.0,
                         [](double sum, const Loop& loop) { return sum + signed_area(loop); });
}

namespace {

/// Whether a ray from the point crosses the loop an odd number of times.
bool encloses(const std::vector<Vec<2>>& polygon, const Vec<2>& p) {
  bool inside = false;
  Vec<2> a = polygon.back();
  for (const Vec<2>& b : polygon) {
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      inside = !inside;
    a = b;
  }
  return inside;
}

}  // namespace

std::vector<Body> bodies(const Outline& outline) {
  constexpr double share_of_chords = 1e-5;
  const double tolerance = share_of_chords * std::sqrt(std::abs(signed_area(outline.loops.front())));
  std::vector<Body> bodies;
  std::vector<std::vector<Vec<2>>> polygons;
  for (const Loop& loop : outline.loops) {
    if (loop.kind != LoopKind::outer_edge && loop.kind != LoopKind::island) continue;
    bodies.push_back({&loop, {}});
    polygons.push_back(flattened(loop, tolerance));
  }
  for (const Loop& loop : outline.loops) {
    if (loop.kind == LoopKind::outer_edge || loop.kind == LoopKind::island) continue;
    Body* owner = nullptr;  // the smallest that encloses it
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (encloses(polygons[i], start_of(loop.curves.front())) &&
          (!owner || signed_area(*bodies[i].edge) < signed_area(*owner->edge)))
        owner = &bodies[i];
    (owner ? owner : &bodies.front())->holes.push_back(&loop);
  }
  return bodies;
}

CurveCount count(const Outline& outline) {
  CurveCount count{static_cast<int>(outline.loops.size()), 0, 0, 0, 0};
  for (const Loop& loop : outline.loops) {
    for (const Curve& curve : loop.curves) {
      if (const auto* spline = std::get_if<Spline>(&curve)) {
        ++count.splines;
        count.cubics += static_cast<int>(spline->points.size()) - 3;
      } else {
        ++(std::holds_alternative<Line>(curve) ? count.lines : count.arcs);
      }
    }
  }
  return count;
}

std::string text(const CurveCount& count) {
  const auto some = [](int n, const char* noun) {
    return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
  };
  std::string result = some(count.loops, "loop") + ": ";
  if (count.lines > 0) result += some(count.lines, "line") + ", ";
  result += some(count.arcs, "arc");
  if (count.splines > 0)
    result += fmt::format(" and {} of {}", some(count.splines, "spline"), some(count.cubics, "cubic"));
  return result;
}

std::string place_of(const Vec<2>& point) {
  const double azimuth = std::atan2(point[1], point[0]);
  return place_text<2>({norm(point), azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth});
}

std::vector<Vec<2>> flattened(const Loop& loop, double tolerance) {
  std::vector<Vec<2>> points;
  for (const Curve& curve : loop.curves) {
    const auto part = flattened(curve, tolerance);
    points.insert(points.end(), part.begin(), part.end());
  }
  return points;
}

}  // namespace wheelwright::cad
