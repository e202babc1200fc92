#include "wheelwright/cad/outline/clearance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/shrinking_ball.h"

namespace wheelwright::cad {
namespace {

double length(const Curve& curve) {
  constexpr int parts = 32;
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += norm(at(curve, (i + 0.5) / parts).velocity) / parts;
  return sum;
}

/// A place on the edges.
struct Place {
  int loop, curve;
  double parameter;
};

/// A point of an edge.
struct DirectedPoint {
  Place place;
  Vec<2> position;
  Vec<2> normal;  ///< unit, into the material
};

DirectedPoint edge_point(const Outline& outline, const Place& place) {
  const CurvePoint point = at(outline.loops[place.loop].curves[place.curve], place.parameter);
  return {place, point.position, left_of(point.velocity) / norm(point.velocity)};
}

Place begin_of_next(const Outline& outline, const Place& place) {
  const int n = static_cast<int>(outline.loops[place.loop].curves.size());
  return {place.loop, (place.curve + 1) % n, 0};
}

Place end_of_previous(const Outline& outline, const Place& place) {
  const int n = static_cast<int>(outline.loops[place.loop].curves.size());
  return {place.loop, (place.curve + n - 1) % n, 1};
}

/// Angle by which the direction turns from one place to another that is at the same point.
double turn(const DirectedPoint& before, const DirectedPoint& after) {
  return std::atan2(cross(before.normal, after.normal), dot(before.normal, after.normal));
}

/// The point at the begin of a curve, with all directions between the normals on either side if there is a
/// corner: a circle may touch it in any of them.
std::vector<DirectedPoint> begin_points(const Outline& outline, const Place& begin) {
  constexpr double step = 5 * std::numbers::pi / 180;
  const DirectedPoint before = edge_point(outline, end_of_previous(outline, begin)),
                      after = edge_point(outline, begin);
  const double angle = turn(before, after);
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / step)));
  std::vector<DirectedPoint> points(parts, after);
  for (int i = 1; i < parts; ++i)
    points[i].normal = wheelwright::rotated<2>(before.normal, angle * i / parts);
  return points;
}

std::vector<DirectedPoint> walk(const Outline& outline, double step) {
  std::vector<DirectedPoint> points;
  for (int loop = 0; loop < static_cast<int>(outline.loops.size()); ++loop) {
    const auto& curves = outline.loops[loop].curves;
    for (int curve = 0; curve < static_cast<int>(curves.size()); ++curve) {
      const auto begin = begin_points(outline, {loop, curve, 0});
      points.insert(points.end(), begin.begin(), begin.end());
      const int parts = static_cast<int>(std::ceil(length(curves[curve]) / step));
      for (int i = 1; i < parts; ++i)
        points.push_back(edge_point(outline, {loop, curve, static_cast<double>(i) / parts}));
    }
  }
  return points;
}

std::vector<Vec<2>> positions(const std::vector<DirectedPoint>& points) {
  std::vector<Vec<2>> result;
  for (const DirectedPoint& point : points) result.push_back(point.position);
  return result;
}

/// The largest circle that touches an edge at one point and contains no other edge.
struct TouchingCircle {
  double radius;
  int touched;  ///< the other point of contact; -1 if there is none
};

/// Shrinks a circle that touches the edge at `p`, with its centre in the direction `n`, until no edge lies in
/// it.
TouchingCircle touching_circle(const NearestPoint<2>& edges, const Vec<2>& p, const Vec<2>& n,
                               double radius) {
  constexpr int max_steps = 100;
  constexpr double slack = 1e-9;
  TouchingCircle circle{radius, -1};
  shrunk_radius<2>(edges, p, n, radius, slack, max_steps, [&](int touched, double smaller) {
    circle = {smaller, touched};
  });
  return circle;
}

/// The second derivative of a curve by its parameter, by differences.
Vec<2> acceleration(const Curve& curve, double parameter) {
  constexpr double step = 1e-4;
  const double before = std::max(0.0, parameter - step), after = std::min(1.0, parameter + step);
  const Vec<2> v = at(curve, before).velocity, w = at(curve, after).velocity;
  return (w - v) / (after - before);
}

/// Moves a place towards the point of its loop that is nearest to a target, at most to the end of its curve
/// and from there to the next one. Whether it moved.
bool approach(const Outline& outline, DirectedPoint& edge, const Vec<2>& target) {
  Place place = edge.place;
  const Curve& curve = outline.loops[place.loop].curves[place.curve];
  const CurvePoint p = at(curve, place.parameter);
  const Vec<2> miss = target - p.position;
  // Newton's step where the curve bends away from the target: without its curvature, the step would go beyond
  // the nearest point of a bend that is tighter than the target is far.
  const double straight = dot(p.velocity, p.velocity),
               bent = straight - dot(miss, acceleration(curve, place.parameter));
  place.parameter += dot(miss, p.velocity) / std::max(straight, bent);
  if (place.parameter > 1) place = begin_of_next(outline, place);
  if (place.parameter < 0) place = end_of_previous(outline, place);
  const bool moves = place.curve != edge.place.curve || place.parameter != edge.place.parameter;
  if (moves) edge = edge_point(outline, place);
  return moves;
}

/// Whether a path in this direction leaves the edge normally, as at the end of a shortest path. At a corner
/// any direction between the normals is allowed.
bool is_straight(const Outline& outline, const DirectedPoint& edge, const Vec<2>& direction) {
  constexpr double cosine = 0.985;  // of ten degrees
  const Place& place = edge.place;
  double corner = 0;
  if (place.parameter == 0) corner = turn(edge_point(outline, end_of_previous(outline, place)), edge);
  if (place.parameter == 1) corner = turn(edge, edge_point(outline, begin_of_next(outline, place)));
  const bool has_room = std::abs(corner) > std::acos(cosine);
  return std::abs(dot(edge.normal, direction)) > (has_room ? 0 : cosine);
}

/// The neck about two places, if there is one.
std::optional<Clearance> neck(const Outline& outline, DirectedPoint from, DirectedPoint to) {
  constexpr int steps = 60;
  constexpr double least_share = 0.5;
  const double before = distance(from.position, to.position);
  for (int k = 0; k < steps; ++k) {
    const bool to_moves = approach(outline, to, from.position);
    if (!approach(outline, from, to.position) && !to_moves) break;
  }
  const double width = distance(from.position, to.position);
  if (!(width > least_share * before && width <= before)) return {};
  const Vec<2> direction = (to.position - from.position) / width;
  if (!is_straight(outline, from, direction) || !is_straight(outline, to, direction)) return {};
  return Clearance{width, from.position, to.position};
}

class Search {
 public:
  Search(const Outline& outline, int n_sectors, double step)
      : outline_(outline),
        step_(step),
        points_(walk(outline, step)),
        edges_(positions(points_)),
        sector_(2 * std::numbers::pi / n_sectors) {
    for (const DirectedPoint& point : points_) reach_ = std::max(reach_, 2 * norm(point.position));
  }

  std::optional<Clearance> thinnest_wall() const {
    return thinnest_neck(circles(1, [](LoopKind) { return true; }));
  }

  std::optional<Clearance> narrowest_gap() const {
    const auto in_holes = circles(-1, [](LoopKind kind) { return kind == LoopKind::hole; });
    auto gap = thinnest_neck(in_holes);
    for (const Circle& circle : widest_of_each_hole(in_holes)) {
      const Circle widest = widened(circle);
      if (!gap || 2 * widest.radius < gap->width) gap = diameter(widest);
    }
    return gap;
  }

 private:
  struct Circle {
    int point, touched;
    double radius;
    double chord;
    Vec<2> at, centre;
  };

  /// The circle at a point, `point` being the nearest of those that were walked along; nothing if it touches
  /// no other point. `side`: 1 in the material, -1 in the voids. `likely`: a radius like that of a neighbour;
  /// it saves the search among far points.
  std::optional<Circle> circle_at(const DirectedPoint& p, int point, double side, double likely) const {
    constexpr double growth = 1.25;
    const Vec<2> n = side * p.normal;
    auto circle = touching_circle(edges_, p.position, n, std::min(growth * likely, reach_));
    if (circle.touched < 0) circle = touching_circle(edges_, p.position, n, reach_);
    const auto [radius, touched] = circle;
    if (touched < 0) return {};
    return Circle{
        .point = point,
        .touched = touched,
        .radius = radius,
        .chord = distance(p.position, points_[touched].position),
        .at = p.position,
        .centre = p.position + radius * n,
    };
  }

  /// The circles at the points of one image of every loop of the kinds that are wanted.
  template <class IsWanted>
  std::vector<Circle> circles(double side, IsWanted is_wanted) const {
    std::vector<Circle> circles;
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      if (!is_wanted(outline_.loops[points_[i].place.loop].kind) || !is_first_image(points_[i])) continue;
      const double likely = circles.empty() ? reach_ : circles.back().radius;
      if (const auto circle = circle_at(points_[i], i, side, likely)) circles.push_back(*circle);
    }
    return circles;
  }

  /// The widest circle in a hole near one of the widest at the points that were walked along.
  Circle widened(Circle circle) const {
    constexpr int steps = 20;
    Place place = points_[circle.point].place;
    double step = step_ / length(outline_.loops[place.loop].curves[place.curve]);
    for (int k = 0; k < steps; ++k) {
      step /= 2;
      for (const double parameter : {place.parameter - step, place.parameter + step}) {
        if (parameter < 0 || parameter > 1) continue;
        const DirectedPoint moved = edge_point(outline_, {place.loop, place.curve, parameter});
        const auto other = circle_at(moved, circle.point, -1, circle.radius);
        if (!other || other->radius <= circle.radius) continue;
        circle = *other;
        place.parameter = parameter;
        break;
      }
    }
    return circle;
  }

  std::optional<Clearance> thinnest_neck(std::vector<Circle> circles) const {
    constexpr double least_angle = 5 * std::numbers::pi / 6;
    std::erase_if(circles,
                  [](const Circle& c) { return c.chord < 2 * c.radius * std::sin(least_angle / 2); });
    std::ranges::sort(circles, {}, &Circle::chord);
    for (const Circle& circle : circles)
      if (const auto found = neck(outline_, points_[circle.point], points_[circle.touched])) return found;
    return {};
  }

  std::vector<Circle> widest_of_each_hole(const std::vector<Circle>& circles) const {
    std::map<int, Circle> widest;
    for (const Circle& circle : circles) {
      const auto [place, is_new] = widest.try_emplace(points_[circle.point].place.loop, circle);
      if (!is_new && circle.radius > place->second.radius) place->second = circle;
    }
    std::vector<Circle> result;
    for (const auto& [loop, circle] : widest) result.push_back(circle);
    return result;
  }

  Clearance diameter(const Circle& circle) const {
    return {2 * circle.radius, circle.at, 2 * circle.centre - circle.at};
  }

  /// One representative sector: the part of circles about the axle in it, and the other loops that start in
  /// it.
  bool is_first_image(const DirectedPoint& point) const {
    const Loop& loop = outline_.loops[point.place.loop];
    const bool about_axle = loop.kind == LoopKind::outer_edge || loop.kind == LoopKind::bore;
    return in_first_sector(about_axle ? point.position : start_of(loop.curves.front()));
  }

  /// The sector starts at an unlikely place for points, to be robust to rounding.
  bool in_first_sector(const Vec<2>& p) const {
    constexpr double begin = 0.0123;  // sectors
    double azimuth = std::atan2(p[1], p[0]) - begin * sector_;
    if (azimuth < 0) azimuth += 2 * std::numbers::pi;
    return azimuth < sector_;
  }

  const Outline& outline_;
  double step_;
  std::vector<DirectedPoint> points_;
  NearestPoint<2> edges_;
  double sector_, reach_ = 0;
};

}  // namespace

Clearances clearances(const Outline& outline, int n_sectors, double step) {
  const Search search(outline, n_sectors, step);
  return {search.thinnest_wall(), search.narrowest_gap()};
}

}  // namespace wheelwright::cad
