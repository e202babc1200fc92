#include "wheelwright/output/report/superlevels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

namespace wheelwright {
namespace {

struct Hash {
  std::size_t operator()(const PicturePoint& p) const {
    return std::hash<std::uint64_t>()(std::uint64_t(std::uint32_t(p[0])) << 32 | std::uint32_t(p[1]));
  }
};

/// Adds a side, or takes out its opposite where that came just before it, as between the triangles of a fan.
void add_side(const PictureSide& side, std::vector<PictureSide>& sides) {
  if (!sides.empty() && sides.back().from == side.to && sides.back().to == side.from)
    sides.pop_back();
  else
    sides.push_back(side);
}

std::int64_t signed_double_area(const PictureScalar::Corners& t) {
  return std::int64_t(t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) -
         std::int64_t(t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
}

}  // namespace

PictureScalar::PictureScalar(const std::vector<Triangle>& triangles) {
  std::unordered_map<PicturePoint, double, Hash> values;
  std::vector<PictureSide> sides;
  values.reserve(triangles.size());
  sides.reserve(3 * triangles.size());
  triangles_.reserve(triangles.size());
  for (auto [corners, given] : triangles) {
    for (int k = 0; k < 3; ++k) given[k] = values.try_emplace(corners[k], given[k]).first->second;
    std::array<Corner, 3> triangle;
    for (int k = 0; k < 3; ++k) triangle[k] = {corners[k], given[k]};
    if (signed_double_area(corners) < 0) std::swap(triangle[1], triangle[2]);
    for (int k = 0; k < 3; ++k) add_side({triangle[k].place, triangle[(k + 1) % 3].place}, sides);
    triangles_.push_back(triangle);
  }
  for (const PictureSide& side : without_opposites(sides))
    boundary_.push_back({{side.from, values.at(side.from)}, {side.to, values.at(side.to)}});
}

std::vector<PicturePolygon> PictureScalar::region() const {
  std::vector<PictureSide> sides;
  for (const Side& side : boundary_) sides.push_back({side.from.place, side.to.place});
  return closed_curves(std::move(sides));
}

/// The point of a side where the scalar takes this value, the same for both triangles at the side.
PicturePoint PictureScalar::crossing(const Corner& from, const Corner& to, double level) {
  const auto& [a, b] = from.place < to.place ? std::tie(from, to) : std::tie(to, from);
  const double t = (level - a.value) / (b.value - a.value);
  return {static_cast<int>(std::lround(std::lerp(double(a.place[0]), double(b.place[0]), t))),
          static_cast<int>(std::lround(std::lerp(double(a.place[1]), double(b.place[1]), t)))};
}

/// For every level, the sides that cut off the part below it, triangle by triangle.
std::vector<std::vector<PictureSide>> PictureScalar::level_lines(const std::vector<double>& levels) const {
  std::vector<std::vector<PictureSide>> lines(levels.size());
  for (const auto& t : triangles_) {
    const auto [low, high] = std::minmax({t[0].value, t[1].value, t[2].value});
    const auto first = std::ranges::upper_bound(levels, low), last = std::ranges::upper_bound(levels, high);
    for (auto level = first; level < last; ++level) {
      PictureSide line{};
      for (int side = 0; side < 3; ++side) {
        const Corner &a = t[side], &b = t[(side + 1) % 3];
        if (a.value >= *level && b.value < *level) line.from = crossing(a, b, *level);
        if (a.value < *level && b.value >= *level) line.to = crossing(a, b, *level);
      }
      lines[level - levels.begin()].push_back(line);
    }
  }
  return lines;
}

/// The part of a side where the scalar reaches the level.
std::optional<PictureSide> PictureScalar::part_above(const Side& side, double level) {
  const bool begins = side.from.value >= level, ends = side.to.value >= level;
  if (!begins && !ends) return {};
  return PictureSide{begins ? side.from.place : crossing(side.from, side.to, level),
                     ends ? side.to.place : crossing(side.from, side.to, level)};
}

/// The part of a side where the scalar does not reach the level.
std::optional<PictureSide> PictureScalar::part_below(const Side& side, double level) {
  const bool begins = side.from.value < level, ends = side.to.value < level;
  if (!begins && !ends) return {};
  return PictureSide{begins ? side.from.place : crossing(side.from, side.to, level),
                     ends ? side.to.place : crossing(side.from, side.to, level)};
}

std::vector<std::vector<PicturePolygon>> PictureScalar::superlevels(const std::vector<double>& levels) const {
  auto sides = level_lines(levels);
  std::vector<std::vector<PicturePolygon>> result;
  for (size_t k = 0; k < levels.size(); ++k) {
    for (const Side& side : boundary_)
      if (const auto part = part_above(side, levels[k])) sides[k].push_back(*part);
    result.push_back(closed_curves(without_opposites(sides[k])));
  }
  return result;
}

std::vector<std::vector<PicturePolygon>> PictureScalar::sublevels(const std::vector<double>& levels) const {
  auto sides = level_lines(levels);
  std::vector<std::vector<PicturePolygon>> result;
  for (size_t k = 0; k < levels.size(); ++k) {
    for (PictureSide& line : sides[k]) std::swap(line.from, line.to);
    for (const Side& side : boundary_)
      if (const auto part = part_below(side, levels[k])) sides[k].push_back(*part);
    result.push_back(closed_curves(without_opposites(sides[k])));
  }
  return result;
}

double PictureScalar::median() const {
  std::vector<double> values;
  for (const auto& triangle : triangles_)
    for (const Corner& corner : triangle) values.push_back(corner.value);
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace wheelwright
