#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "wheelwright/output/page/report_run.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

using Points = std::vector<std::array<int, 2>>;

double distance_to_chord(const std::array<int, 2>& p, const std::array<int, 2>& a,
                         const std::array<int, 2>& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(p[0] - a[0], p[1] - a[1]);
  return std::abs(dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / length;
}

/// Douglas-Peucker simplification between two points: appends the points before `end` that are needed to stay
/// within the tolerance.
void simplify(const Points& points, std::size_t begin, std::size_t end, double tolerance, Points& result) {
  std::size_t farthest = begin;
  double largest = tolerance;
  for (std::size_t k = begin + 1; k < end; ++k) {
    const double d = distance_to_chord(points[k], points[begin], points[end]);
    if (d > largest) {
      largest = d;
      farthest = k;
    }
  }
  if (farthest == begin) {
    result.push_back(points[begin]);
    return;
  }
  simplify(points, begin, farthest, tolerance, result);
  simplify(points, farthest, end, tolerance, result);
}

Points simplified(Points points) {
  constexpr double tolerance = 2;
  points.push_back(points.front());
  const std::size_t half = points.size() / 2;  // a closed curve has no chord from its first to its last point
  Points result;
  simplify(points, 0, half, tolerance, result);
  simplify(points, half, points.size() - 1, tolerance, result);
  return result;
}

}  // namespace

ShapeOutline shape_outline(int shape, double objective, const LevelSet<2>& psi) {
  const double units = outline_units / psi.lattice.grid().outer_radius;
  ShapeOutline outline{shape, objective, {}};
  for (const Contour& contour : material_contours(psi, 2)) {
    if (contour.kind != ContourKind::free) continue;
    Points points;
    for (const Vec<2>& x : contour.points)
      points.push_back(
          {static_cast<int>(std::lround(x[0] * units)), static_cast<int>(std::lround(x[1] * units))});
    outline.contours.push_back(simplified(std::move(points)));
  }
  return outline;
}

std::string outline_line(const ShapeOutline& outline) {
  return nlohmann::json{
             {"shape", outline.shape}, {"objective", outline.objective}, {"contours", outline.contours}}
             .dump() +
         '\n';
}

std::optional<ShapeOutline> parse_outline_line(const std::string& line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  try {
    return ShapeOutline{json.at("shape").get<int>(),
                        json.value("objective", std::numeric_limits<double>::quiet_NaN()),
                        json.at("contours").get<std::vector<std::vector<std::array<int, 2>>>>()};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace wheelwright
