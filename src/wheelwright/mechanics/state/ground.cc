#include "wheelwright/mechanics/state/ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace wheelwright {
namespace {

constexpr double far_away = 1e4;  // where level ground ends [m]

/// The tilt of a direction [along, height] from a place to the ground.
double tilt_of(const Vec<2>& direction) { return std::atan2(direction[0], -direction[1]); }

Vec<2> difference(const Vec<2>& a, const Vec<2>& b) { return {a[0] - b[0], a[1] - b[1]}; }

/// The normal of a face, away from the ground.
Vec<2> normal_of(const Vec<2>& from, const Vec<2>& to) {
  const Vec<2> d = difference(to, from);
  const double length = std::hypot(d[0], d[1]);
  return {-d[1] / length, d[0] / length};
}

}  // namespace

Ground Ground::drum(double radius) {
  return Ground({.rounds = {{{0, 0}, radius}}, .faces = {}, .is_drum = true, .is_symmetric = true});
}

Ground Ground::internal_drum(double radius) {
  return Ground({.rounds = {{{0, 0}, radius, true}}, .faces = {}, .is_drum = true, .is_symmetric = true});
}

Ground Ground::bar(double place, double radius, double height) {
  return Ground({.rounds = {{{place, height}, radius}},
                 .faces = {{{-far_away, 0}, {far_away, 0}}},
                 .is_symmetric = place == 0});
}

Ground Ground::kerb(double place, double height, double edge_radius) {
  Outline outline{
      .rounds = {{{place + edge_radius, height}, edge_radius}},
      .faces = {{{-far_away, 0}, {place, 0}}, {{place + edge_radius, height}, {far_away, height}}}};
  if (edge_radius < height) outline.faces.push_back({{place, 0}, {place, height - edge_radius}});
  return Ground(std::move(outline));
}

Ground Ground::profile(const std::vector<Vec<2>>& points) {
  Outline outline;
  Vec<2> last{points.front()[0] - far_away, points.front()[1]};
  for (const Vec<2>& point : points) {
    outline.rounds.push_back({point, 0});
    outline.faces.push_back({last, point});
    last = point;
  }
  outline.faces.push_back({last, {last[0] + far_away, last[1]}});
  return Ground(std::move(outline));
}

Ground::Nearest Ground::nearest(const Round& round, const Vec<2>& place) {
  // With the place p from the highest point of the circle: |p - c| - r without cancellation.
  const Vec<2> p = difference(place, round.top);
  const double sign = round.hollow ? -1 : 1;
  const Vec<2> from_centre{p[0], p[1] + sign * round.radius};
  const double distance = std::hypot(from_centre[0], from_centre[1]), sum = distance + round.radius;
  if (sum == 0) return {0, 0};
  return {sign * (p[0] * p[0] + p[1] * p[1] + sign * 2 * round.radius * p[1]) / sum,
          tilt_of({-sign * from_centre[0], -sign * from_centre[1]})};
}

/// Infinitely far if the nearest place is an end of the face.
Ground::Nearest Ground::nearest(const Face& face, const Vec<2>& place) {
  const Vec<2> d = difference(face.to, face.from), p = difference(place, face.from);
  const double along = p[0] * d[0] + p[1] * d[1];
  if (along < 0 || along > d[0] * d[0] + d[1] * d[1]) return {std::numeric_limits<double>::infinity(), 0};
  const Vec<2> normal = normal_of(face.from, face.to);
  return {p[0] * normal[0] + p[1] * normal[1], tilt_of({-normal[0], -normal[1]})};
}

Ground::Nearest Ground::nearest(const Vec<2>& place) const {
  if (is_flat()) return {place[1], 0};
  Nearest result{std::numeric_limits<double>::infinity(), 0};
  // A place on one face is far behind another, such as the side of a kerb.
  const auto take = [&](const Nearest& candidate) {
    if (std::abs(candidate.gap) < std::abs(result.gap)) result = candidate;
  };
  // No part is nearest that lies further away along the ground than the ground straight below.
  const double below = std::abs(place[1] - height(place[0]));
  const auto may_be_nearest = [&](double from, double to) {
    return place[0] >= from - below && place[0] <= to + below;
  };
  for (const Face& face : outline_->faces)
    if (may_be_nearest(face.from[0], face.to[0])) take(nearest(face, place));
  for (const Round& round : outline_->rounds)
    if (may_be_nearest(round.top[0] - round.radius, round.top[0] + round.radius)) take(nearest(round, place));
  return result;
}

Ground::Standing Ground::standing(double radius) const {
  if (is_flat()) return {0, 0, 0};
  if (outline_->is_drum) {
    const Round& drum = outline_->rounds.front();
    return {0, 0, (drum.hollow ? -1 : 1) / drum.radius};
  }
  Standing result{-std::numeric_limits<double>::infinity(), 0, 0};
  for (const Face& face : outline_->faces) {
    const Vec<2> normal = normal_of(face.from, face.to);
    if (normal[1] <= 0) continue;
    const double height = (radius + face.from[0] * normal[0] + face.from[1] * normal[1]) / normal[1],
                 foot = -radius * normal[0];
    if (foot < face.from[0] || foot > face.to[0] || height - radius <= result.rise) continue;
    result = {height - radius, tilt_of({-normal[0], -normal[1]}), 0};
  }
  for (const Round& round : outline_->rounds) {
    const double reach = radius + round.radius, along = round.top[0];
    if (std::abs(along) >= reach) continue;
    const double above = std::sqrt(reach * reach - along * along);  // of the centre of the round part
    const double rise = round.top[1] - round.radius + above - radius;
    if (rise <= result.rise) continue;
    result = {rise, tilt_of({along, -above}), 1 / round.radius};
  }
  return result;
}

double Ground::height(double along) const {
  if (is_flat()) return 0;
  double result = -std::numeric_limits<double>::infinity();
  for (const Face& face : outline_->faces)
    if (face.from[0] < face.to[0] && along >= face.from[0] && along <= face.to[0])
      result = std::max(result, face.from[1] + (along - face.from[0]) / (face.to[0] - face.from[0]) *
                                                   (face.to[1] - face.from[1]));
  for (const Round& round : outline_->rounds) {
    const double x = along - round.top[0], sign = round.hollow ? -1 : 1;
    if (std::abs(x) <= round.radius)
      result = std::max(
          result, round.top[1] + sign * (std::sqrt((round.radius - x) * (round.radius + x)) - round.radius));
  }
  return result;
}

Ground Ground::shifted(double along) const {
  if (is_even()) return *this;
  Outline outline = *outline_;
  outline.is_symmetric = false;
  for (Round& round : outline.rounds) round.top[0] += along;
  for (Face& face : outline.faces) {
    face.from[0] += along;
    face.to[0] += along;
  }
  return Ground(std::move(outline));
}

std::vector<Vec<2>> Ground::line(double from, double to, double deviation) const {
  std::vector<Vec<2>> points;
  const auto add = [&](double along) {
    if (along < from || along > to) return;
    if (const double y = height(along); std::isfinite(y)) points.push_back({along, y});
  };
  std::vector<double> places{from, to};
  if (!is_flat()) {
    for (const Face& face : outline_->faces)
      for (const double x : {face.from[0], face.to[0]})
        places.insert(places.end(), {x - deviation, x, x + deviation});
    for (const Round& round : outline_->rounds) {
      const int n = round.radius == 0
                        ? 1
                        : static_cast<int>(std::ceil(std::numbers::pi /
                                                     std::sqrt(8 * std::min(0.1, deviation / round.radius))));
      for (int k = -n; k <= n; ++k)
        places.push_back(round.top[0] + round.radius * std::sin(0.5 * std::numbers::pi * k / n));
      for (const double side : {-1, 1}) places.push_back(round.top[0] + side * (round.radius + deviation));
    }
  }
  std::ranges::sort(places);
  for (const double x : places) add(x);
  return points;
}

bool Ground::operator==(const Ground& other) const {
  return outline_ == other.outline_ || (outline_ && other.outline_ && *outline_ == *other.outline_);
}

double effective_radius(const Ground& ground, double radius) {
  constexpr double smallest = 0.01;  // of an edge, in radii
  const double curvature = ground.standing(radius).curvature;
  return curvature == 0 ? radius : 1 / (1 / radius + std::min(curvature, 1 / (smallest * radius)));
}

}  // namespace wheelwright
