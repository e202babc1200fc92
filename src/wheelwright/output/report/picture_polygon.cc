#include "wheelwright/output/report/picture_polygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace wheelwright {
namespace {

/// Twice the area, positive for one sense of turning.
std::int64_t signed_double_area(const PicturePolygon& polygon) {
  std::int64_t sum = 0;
  PicturePoint a = polygon.back();
  for (const PicturePoint& b : polygon) {
    sum += std::int64_t(a[0]) * b[1] - std::int64_t(a[1]) * b[0];
    a = b;
  }
  return sum;
}

/// Whether b lies on the straight line from a to c.
bool is_between(const PicturePoint& a, const PicturePoint& b, const PicturePoint& c) {
  const std::int64_t ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
  return ux * vy == uy * vx && ux * vx + uy * vy >= 0;
}

PicturePolygon corners(const PicturePolygon& outline) {
  PicturePolygon result;
  const std::size_t n = outline.size();
  for (std::size_t k = 0; k < n; ++k)
    if (!is_between(result.empty() ? outline[(k + n - 1) % n] : result.back(), outline[k],
                    outline[(k + 1) % n]))
      result.push_back(outline[k]);
  return result;
}

double distance_to_chord(const PicturePoint& p, const PicturePoint& a, const PicturePoint& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], px = p[0] - a[0], py = p[1] - a[1];
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(px - t * dx, py - t * dy);
}

/// Points as one number, in the order of the points.
std::uint64_t packed(const PicturePoint& p) {
  constexpr std::uint32_t sign = 0x80000000u;
  return std::uint64_t(std::uint32_t(p[0]) ^ sign) << 32 | (std::uint32_t(p[1]) ^ sign);
}
PicturePoint unpacked(std::uint64_t p) {
  constexpr std::uint32_t sign = 0x80000000u;
  return {int(std::uint32_t(p >> 32) ^ sign), int(std::uint32_t(p) ^ sign)};
}

struct CountedSide {
  std::uint64_t lower = 0, upper = 0;  ///< packed; the same for a place without a side
  int surplus = 0;                     ///< of the sides from the lower point to the upper one
  auto operator<=>(const CountedSide&) const = default;
};

/// Counts sides by their points: a table with open addressing, which has room for a number of sides.
class SideCounts {
 public:
  explicit SideCounts(std::size_t most) : sides_(std::bit_ceil(most + most / 2 + 1)) {}

  void add(const PictureSide& side) {
    const std::uint64_t from = packed(side.from), to = packed(side.to);
    if (from == to) return;
    CountedSide& counted = at(std::min(from, to), std::max(from, to));
    counted.surplus += from < to ? 1 : -1;
  }

  /// The sides with a surplus, in the order of their points.
  std::vector<CountedSide> left() && {
    std::erase_if(sides_, [](const CountedSide& side) { return side.surplus == 0; });
    std::ranges::sort(sides_);
    return std::move(sides_);
  }

 private:
  CountedSide& at(std::uint64_t lower, std::uint64_t upper) {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u;
    std::uint64_t place = (lower * odd ^ upper) * odd;
    for (place ^= place >> 32;; ++place) {
      CountedSide& side = sides_[place & (sides_.size() - 1)];
      if (side.lower == side.upper) side = {lower, upper, 0};
      if (side.lower == lower && side.upper == upper) return side;
    }
  }

  std::vector<CountedSide> sides_;
};

auto by_beginning(const PictureSide& side) { return std::tie(side.from, side.to); }

}  // namespace

void add_sides(const PicturePolygon& polygon, std::vector<PictureSide>& sides) {
  if (polygon.empty()) return;
  const bool forward = signed_double_area(polygon) >= 0;
  PicturePoint a = polygon.back();
  for (const PicturePoint& b : polygon) {
    sides.push_back(forward ? PictureSide{a, b} : PictureSide{b, a});
    a = b;
  }
}

std::vector<PictureSide> without_opposites(const std::vector<PictureSide>& sides) {
  SideCounts counts(sides.size());
  for (const PictureSide& side : sides) counts.add(side);
  std::vector<PictureSide> result;
  for (const auto& [lower, upper, surplus] : std::move(counts).left()) {
    const PictureSide side{unpacked(lower), unpacked(upper)};
    result.insert(result.end(), std::abs(surplus), surplus > 0 ? side : PictureSide{side.to, side.from});
  }
  return result;
}

std::vector<PicturePolygon> closed_curves(std::vector<PictureSide> sides) {
  std::ranges::sort(sides, {}, by_beginning);
  std::vector<bool> taken(sides.size(), false);
  const auto next_from = [&](const PicturePoint& point) {
    auto k = std::ranges::lower_bound(sides, point, {}, &PictureSide::from) - sides.begin();
    while (taken[k]) ++k;
    return k;
  };
  std::vector<PicturePolygon> curves;
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (taken[first]) continue;
    PicturePolygon curve;
    for (auto k = static_cast<std::ptrdiff_t>(first);; k = next_from(sides[k].to)) {
      taken[k] = true;
      curve.push_back(sides[k].from);
      if (sides[k].to == sides[first].from) break;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<PicturePolygon> union_outlines(const std::vector<PicturePolygon>& polygons) {
  std::vector<PictureSide> sides;
  for (const PicturePolygon& polygon : polygons) add_sides(polygon, sides);
  return closed_curves(without_opposites(sides));
}

PicturePolygon simplified(const PicturePolygon& curve, double tolerance) {
  constexpr std::size_t longest = 40;  // points replaced by one chord
  if (curve.size() < 4) return curve;
  PicturePolygon result{curve[0]};
  for (std::size_t from = 0; from + 1 < curve.size();) {
    std::size_t to = from + 1;
    const auto is_near = [&](std::size_t end) {
      for (std::size_t k = from + 1; k < end; ++k)
        if (distance_to_chord(curve[k], curve[from], curve[end]) > tolerance) return false;
      return true;
    };
    while (to + 1 < curve.size() && to - from < longest && is_near(to + 1)) ++to;
    result.push_back(curve[to]);
    from = to;
  }
  return result;
}

std::string outline_path(const std::vector<PicturePolygon>& outlines) {
  std::string path;
  for (const PicturePolygon& all_points : outlines) {
    const PicturePolygon outline = corners(all_points);
    if (outline.size() < 3) continue;
    path += fmt::format("M{} {}l", outline[0][0], outline[0][1]);
    for (std::size_t k = 1; k < outline.size(); ++k) {
      const int dx = outline[k][0] - outline[k - 1][0], dy = outline[k][1] - outline[k - 1][1];
      path += fmt::format("{}{}{}{}", k > 1 && dx >= 0 ? " " : "", dx, dy >= 0 ? " " : "", dy);
    }
    path += 'z';
  }
  return path;
}

}  // namespace wheelwright
