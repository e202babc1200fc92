#include "wheelwright/cad/outline/roughness.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright::cad {
namespace {

/// The curvature is averaged over this share of the length to either side.
constexpr double share_of_mean = 1.0 / 3;
/// Steps along the edge per length to either side.
constexpr int steps_of_mean = 16;
/// An edge that bends by less per length is straight [rad].
constexpr double straight = 0.01;

/// Angle from one direction to another.
double angle(const Vec<2>& a, const Vec<2>& b) { return std::atan2(cross(a, b), dot(a, b)); }

/// A point of an edge, with the length and turning of the edge since its start.
struct EdgePoint {
  double arc;   ///< [m]
  double turn;  ///< [rad], counter-clockwise
  Vec<2> position;
};

double polygon_length(const Curve& curve) {
  constexpr int parts = 32;
  double sum = 0;
  for (int i = 0; i < parts; ++i)
    sum += distance(at(curve, static_cast<double>(i) / parts).position,
                    at(curve, static_cast<double>(i + 1) / parts).position);
  return sum;
}

/// Points along an edge at steps of about `step`. A corner is two points at the same place, also the one
/// where the edge closes.
std::vector<EdgePoint> walk(const Loop& loop, double step) {
  std::vector<EdgePoint> points;
  const CurvePoint first = at(loop.curves.front(), 0);
  EdgePoint last{0, 0, first.position};
  Vec<2> direction = first.velocity;
  const auto advance = [&](const CurvePoint& p) {
    last = {last.arc + distance(last.position, p.position), last.turn + angle(direction, p.velocity),
            p.position};
    direction = p.velocity;
    points.push_back(last);
  };
  for (const Curve& curve : loop.curves) {
    const int parts = std::max(1, static_cast<int>(std::ceil(polygon_length(curve) / step)));
    for (int i = 0; i <= parts; ++i) advance(at(curve, static_cast<double>(i) / parts));
  }
  advance(first);
  return points;
}

/// An edge divided into parts of equal length.
struct EqualParts {
  double length;  ///< of a part [m]
  std::vector<double> turns;
  std::vector<Vec<2>> places;  ///< about the middle of each part
};

EqualParts equal_parts(const std::vector<EdgePoint>& points, double step) {
  const int n = std::max(1, static_cast<int>(std::lround(points.back().arc / step)));
  EqualParts parts{points.back().arc / n, {}, {}};
  double before = 0;
  std::size_t next = 0;
  for (int i = 1; i <= n; ++i) {
    const double middle = (i - 0.5) * parts.length, end = i * parts.length;
    while (next + 1 < points.size() && points[next].arc < middle) ++next;
    parts.places.push_back(points[next].position);
    while (next + 1 < points.size() && points[next].arc < end) ++next;
    double turn = points.back().turn;
    if (i < n) {
      const EdgePoint &a = points[next - 1], &b = points[next];
      turn = a.turn + (end - a.arc) / (b.arc - a.arc) * (b.turn - a.turn);
    }
    parts.turns.push_back(turn - before);
    before = turn;
  }
  return parts;
}

/// The mean curvature in the middle of every part.
std::vector<double> mean_curvatures(const EqualParts& parts) {
  const int n = static_cast<int>(parts.turns.size());
  const double width = steps_of_mean * parts.length;
  std::vector<double> result(n, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 1 - steps_of_mean; j < steps_of_mean; ++j)
      result[i] +=
          (1 - std::abs(j) / static_cast<double>(steps_of_mean)) / width * parts.turns[((i + j) % n + n) % n];
  return result;
}

/// Integral over [0, 1] of a linear function where that is more than a positive bound.
double integral_above(double bound, double begin, double end) {
  const auto [low, high] = std::minmax(begin, end);
  if (low > bound) return 0.5 * (low + high);
  if (high <= bound) return 0;
  return (high - bound) / (high - low) * 0.5 * (high + bound);
}

/// The edges of holes and islands, one of those that are images of each other.
std::vector<const Loop*> representatives(const Outline& outline, int n_sectors) {
  constexpr double same = 1e-6;  // of the radius
  const double sector = 2 * std::numbers::pi / n_sectors;
  std::vector<const Loop*> result;
  const auto is_image = [&](const Loop* loop, const Loop* other) {
    const Vec<2> a = start_of(loop->curves.front()), b = start_of(other->curves.front());
    const double sectors = angle(a, b) / sector;
    return distance(wheelwright::rotated<2>(a, std::round(sectors) * sector), b) < same * norm(b);
  };
  for (const Loop& loop : outline.loops) {
    if (loop.kind != LoopKind::hole && loop.kind != LoopKind::island) continue;
    if (std::ranges::none_of(result, [&](const Loop* other) { return is_image(&loop, other); }))
      result.push_back(&loop);
  }
  return result;
}

std::optional<Bend> sharper(const std::optional<Bend>& a, const std::optional<Bend>& b) {
  return !a || (b && b->radius < a->radius) ? b : a;
}

}  // namespace

EdgeRoughness edge_roughness(const Loop& loop, double length) {
  const double step = share_of_mean * length / steps_of_mean;
  const EqualParts parts = equal_parts(walk(loop, step), step);
  const std::vector<double> kappa = mean_curvatures(parts);
  double sum = 0;
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    const double begin = kappa[i], end = kappa[(i + 1) % kappa.size()];
    sum += parts.length * (integral_above(1 / length, begin, end) + integral_above(1 / length, -begin, -end));
  }
  const auto bend = [&](auto found) {
    return Bend{1 / std::abs(*found), parts.places[found - kappa.begin()]};
  };
  // The material is on the left.
  const auto [internal, external] = std::ranges::minmax_element(kappa);
  EdgeRoughness result{
      sum / (2 * std::numbers::pi), bend(-*internal > *external ? internal : external), {}, {}};
  if (-*internal * length > straight) result.internal_corner = bend(internal);
  if (*external * length > straight) result.external_corner = bend(external);
  return result;
}

std::optional<Roughness> roughness(const Outline& outline, int n_sectors, double length) {
  std::optional<Roughness> all;
  for (const Loop* loop : representatives(outline, n_sectors)) {
    const EdgeRoughness edge = edge_roughness(*loop, length);
    if (!all) all = Roughness{length, edge, {}, {}};
    if (edge.turns > all->edge.turns) all->edge = edge;
    all->internal_corner = sharper(all->internal_corner, edge.internal_corner);
    all->external_corner = sharper(all->external_corner, edge.external_corner);
  }
  return all;
}

}  // namespace wheelwright::cad
