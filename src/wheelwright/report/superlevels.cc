#include "wheelwright/report/superlevels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wheelwright {
namespace {

std::int64_t signed_double_area(const PictureScalar::Corners& t) {
  return std::int64_t(t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) -
         std::int64_t(t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
}

}  // namespace

std::size_t PictureScalar::Hash::operator()(const PicturePoint& p) const {
  return std::hash<std::uint64_t>()(std::uint64_t(std::uint32_t(p[0])) << 32 | std::uint32_t(p[1]));
}

PictureScalar::PictureScalar(const std::vector<Triangle>& triangles) {
  std::vector<PictureSide> sides;
  for (auto [corners, values] : triangles) {
    for (int k = 0; k < 3; ++k) values_.try_emplace(corners[k], values[k]);
    if (signed_double_area(corners) < 0) std::swap(corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) sides.push_back({corners[k], corners[(k + 1) % 3]});
    triangles_.push_back(corners);
  }
  boundary_ = without_opposites(std::move(sides));
}

std::vector<PicturePolygon> PictureScalar::region() const { return closed_curves(boundary_); }

/// The point of a side where the scalar takes this value, the same for both triangles at the side.
PicturePoint PictureScalar::crossing(PicturePoint a, PicturePoint b, double level) const {
  if (b < a) std::swap(a, b);
  const double t = (level - value(a)) / (value(b) - value(a));
  return {static_cast<int>(std::lround(std::lerp(double(a[0]), double(b[0]), t))),
          static_cast<int>(std::lround(std::lerp(double(a[1]), double(b[1]), t)))};
}

/// For every level the sides that cut off what is below it, triangle by triangle.
std::vector<std::vector<PictureSide>> PictureScalar::level_lines(const std::vector<double>& levels) const {
  std::vector<std::vector<PictureSide>> lines(levels.size());
  for (const Corners& t : triangles_) {
    const auto [low, high] = std::minmax({value(t[0]), value(t[1]), value(t[2])});
    for (size_t k = 0; k < levels.size(); ++k) {
      if (!(low < levels[k] && levels[k] <= high)) continue;
      PictureSide line{};
      for (int side = 0; side < 3; ++side) {
        const PicturePoint &a = t[side], &b = t[(side + 1) % 3];
        if (value(a) >= levels[k] && value(b) < levels[k]) line.from = crossing(a, b, levels[k]);
        if (value(a) < levels[k] && value(b) >= levels[k]) line.to = crossing(a, b, levels[k]);
      }
      lines[k].push_back(line);
    }
  }
  return lines;
}

/// The part of a side where the scalar reaches the level.
std::optional<PictureSide> PictureScalar::part_above(const PictureSide& side, double level) const {
  const bool begins = value(side.from) >= level, ends = value(side.to) >= level;
  if (!begins && !ends) return {};
  return PictureSide{begins ? side.from : crossing(side.from, side.to, level),
                     ends ? side.to : crossing(side.from, side.to, level)};
}

/// The part of a side where the scalar does not reach the level.
std::optional<PictureSide> PictureScalar::part_below(const PictureSide& side, double level) const {
  const bool begins = value(side.from) < level, ends = value(side.to) < level;
  if (!begins && !ends) return {};
  return PictureSide{begins ? side.from : crossing(side.from, side.to, level),
                     ends ? side.to : crossing(side.from, side.to, level)};
}

std::vector<std::vector<PicturePolygon>> PictureScalar::superlevels(const std::vector<double>& levels) const {
  auto sides = level_lines(levels);
  std::vector<std::vector<PicturePolygon>> result;
  for (size_t k = 0; k < levels.size(); ++k) {
    for (const PictureSide& side : boundary_)
      if (const auto part = part_above(side, levels[k])) sides[k].push_back(*part);
    result.push_back(closed_curves(without_opposites(std::move(sides[k]))));
  }
  return result;
}

std::vector<std::vector<PicturePolygon>> PictureScalar::sublevels(const std::vector<double>& levels) const {
  auto sides = level_lines(levels);
  std::vector<std::vector<PicturePolygon>> result;
  for (size_t k = 0; k < levels.size(); ++k) {
    for (PictureSide& line : sides[k]) std::swap(line.from, line.to);
    for (const PictureSide& side : boundary_)
      if (const auto part = part_below(side, levels[k])) sides[k].push_back(*part);
    result.push_back(closed_curves(without_opposites(std::move(sides[k]))));
  }
  return result;
}

double PictureScalar::median() const {
  std::vector<double> values;
  for (const Corners& t : triangles_)
    for (const PicturePoint& corner : t) values.push_back(value(corner));
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace wheelwright
