#include "wheelwright/shape/surface/check_surface.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

namespace wheelwright {
namespace {

using Points = std::span<const Vec<3>>;
using Triangles = std::span<const std::array<int, 3>>;

/// A side of a triangle, from its first to its second vertex.
struct Side {
  std::int32_t from, to;
  std::int32_t triangle, corner;  ///< at which it begins

  std::uint64_t key() const { return std::uint64_t(std::uint32_t(from)) << 32 | std::uint32_t(to); }
};

std::vector<Side> sorted_sides(Triangles triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::int32_t t = 0; t < std::ssize(triangles); ++t)
    for (std::int32_t k = 0; k < 3; ++k) sides.push_back({triangles[t][k], triangles[t][(k + 1) % 3], t, k});
  std::ranges::sort(sides, {}, &Side::key);
  return sides;
}

/// The side from one vertex to another; null if there is none.
const Side* find(const std::vector<Side>& sides, std::int32_t from, std::int32_t to) {
  const Side wanted{from, to, 0, 0};
  const auto found = std::ranges::lower_bound(sides, wanted.key(), {}, &Side::key);
  return found != sides.end() && found->key() == wanted.key() ? &*found : nullptr;
}

Vec<3> doubled_area(Points points, const std::array<int, 3>& t) {
  return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

std::optional<SurfaceFault> find_bad_side(Points points, const std::vector<Side>& sides) {
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && sides[i].key() == sides[i - 1].key())
      return SurfaceFault{
          "more than two triangles meet at an edge, or two of them have the same direction there",
          points[sides[i].from]};
    if (find(sides, sides[i].to, sides[i].from) == nullptr)
      return SurfaceFault{"the surface is open at an edge", points[sides[i].from]};
  }
  return {};
}

/// A walk around a vertex must reach all triangles at it.
std::optional<SurfaceFault> find_bad_vertex(Points points, Triangles triangles,
                                            const std::vector<Side>& sides) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin;
    while (end < sides.size() && sides[end].from == sides[begin].from) ++end;
    std::size_t fan = 0;
    std::int32_t to = sides[begin].to;
    do {
      const Side& side = *find(sides, sides[begin].from, to);
      to = triangles[side.triangle][(side.corner + 2) % 3];
      ++fan;
    } while (to != sides[begin].to);
    if (fan != end - begin)
      return SurfaceFault{"two parts of the surface touch at a vertex", points[sides[begin].from]};
    begin = end;
  }
  return {};
}

std::optional<SurfaceFault> find_degenerate(Points points, Triangles triangles) {
  for (const auto& t : triangles)
    if (!(norm<3>(doubled_area(points, t)) > 0)) return SurfaceFault{"a triangle has no area", points[t[0]]};
  std::vector<Vec<3>> sorted(points.begin(), points.end());
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    return SurfaceFault{"two vertices are at the same place", *twice};
  return {};
}

/// The number of the connected piece of every triangle.
std::vector<int> pieces(Triangles triangles, const std::vector<Side>& sides) {
  std::vector<int> piece(triangles.size(), -1);
  std::vector<std::int32_t> front;
  int n = 0;
  for (std::int32_t first = 0; first < std::ssize(triangles); ++first) {
    if (piece[first] >= 0) continue;
    piece[first] = n;
    front.push_back(first);
    while (!front.empty()) {
      const auto t = triangles[front.back()];
      front.pop_back();
      for (int k = 0; k < 3; ++k) {
        const std::int32_t next = find(sides, t[(k + 1) % 3], t[k])->triangle;
        if (piece[next] >= 0) continue;
        piece[next] = n;
        front.push_back(next);
      }
    }
    ++n;
  }
  return piece;
}

}  // namespace

Expected<SurfaceReport, SurfaceFault> check_surface(Points points, Triangles triangles) {
  if (triangles.empty()) return SurfaceFault{"there is no material", {}};
  const auto sides = sorted_sides(triangles);
  std::vector<char> used(points.size(), 0);
  for (const Side& side : sides) used[side.from] = 1;
  if (const auto unused = std::ranges::find(used, 0); unused != used.end())
    return SurfaceFault{"a vertex belongs to no triangle", points[unused - used.begin()]};
  if (auto fault = find_degenerate(points, triangles)) return *fault;
  if (auto fault = find_bad_side(points, sides)) return *fault;
  if (auto fault = find_bad_vertex(points, triangles, sides)) return *fault;

  const auto piece = pieces(triangles, sides);
  std::vector<double> volumes(1 + *std::ranges::max_element(piece), 0);
  std::vector<Vec<3>> somewhere(volumes.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& corner = points[triangles[t][0]];
    volumes[piece[t]] += dot<3>(corner, doubled_area(points, triangles[t])) / 6;
    somewhere[piece[t]] = corner;
  }
  SurfaceReport report{0, 0, 0, std::accumulate(volumes.begin(), volumes.end(), 0.0)};
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    if (volumes[k] == 0) return SurfaceFault{"a piece of the surface encloses nothing", somewhere[k]};
    ++(volumes[k] > 0 ? report.bodies : report.cavities);
  }
  report.euler_characteristic =
      static_cast<int>(std::ssize(points) - std::ssize(sides) / 2 + std::ssize(triangles));
  return report;
}

}  // namespace wheelwright
