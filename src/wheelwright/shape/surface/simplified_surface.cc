#include "wheelwright/shape/surface/simplified_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "wheelwright/shape/geometry/axle_rotation.h"
#include "wheelwright/shape/surface/zero_surface.h"

namespace wheelwright {
namespace {

/// A vertex of sector 0, or its image `sector` sectors further.
struct Image {
  int vertex, sector;

  auto operator<=>(const Image&) const = default;
};

struct Facet {
  std::array<Image, 3> corners;
  SurfacePart part;
  bool is_left = true;
};

/// The triangles of one sector, whose corners may be images of its vertices in other sectors.
class Simplification {
 public:
  Simplification(const SurfaceMesh& mesh, const LevelSet<3>& psi, double tolerance)
      : mesh_(mesh),
        grid_(psi.lattice.grid()),
        zero_(psi),
        tolerance_(tolerance),
        at_vertex_(mesh.sector_points()),
        changes_(mesh.sector_points(), 0) {
    for (int s = 0; s < mesh.n_sectors; ++s) rotations_.emplace_back(s * grid_.sector_angle());
    const std::size_t count = mesh.triangles.size() / mesh.n_sectors;
    for (std::size_t t = 0; t < count; ++t) {
      Facet facet{{}, mesh.parts[t]};
      for (int k = 0; k < 3; ++k)
        facet.corners[k] = {mesh.triangles[t][k] % mesh.sector_points(),
                            mesh.triangles[t][k] / mesh.sector_points()};
      for (const Image& corner : facet.corners) at_vertex_[corner.vertex].push_back(static_cast<int>(t));
      facets_.push_back(facet);
    }
  }

  /// Tries every edge once in both directions, those first that change the surface least; returns how many
  /// vertices were removed.
  int pass() {
    int removed = 0;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
    for (int v = 0; v < mesh_.sector_points(); ++v)
      for (const Image& to : neighbours(v)) push(v, to, queue);
    while (!queue.empty()) {
      const Candidate next = queue.top();
      queue.pop();
      if (next.changes != changes_[next.from] + changes_[next.to.vertex]) {
        if (is_edge(next.from, next.to)) push(next.from, next.to, queue);
        continue;
      }
      merge(next.from, next.to);
      ++removed;
    }
    return removed;
  }

  SurfaceMesh result() const {
    SurfaceMesh fewer{mesh_.n_sectors, {}, {}, {}, {}};
    std::vector<int> number(mesh_.sector_points(), -1);
    for (int v = 0; v < mesh_.sector_points(); ++v) {
      if (at_vertex_[v].empty()) continue;
      number[v] = fewer.sector_points();
      fewer.places.push_back(mesh_.places[v]);
    }
    for (int s = 0; s < mesh_.n_sectors; ++s) {
      for (int v = 0; v < mesh_.sector_points(); ++v)
        if (number[v] >= 0) fewer.points.push_back(point({v, s}));
      for (const Facet& facet : facets_) {
        if (!facet.is_left) continue;
        std::array<int, 3> triangle;
        for (int k = 0; k < 3; ++k)
          triangle[k] =
              number[facet.corners[k].vertex] + turned(facet.corners[k].sector + s) * fewer.sector_points();
        fewer.triangles.push_back(triangle);
        fewer.parts.push_back(facet.part);
      }
    }
    return fewer;
  }

 private:
  /// A vertex that could be moved to a neighbour.
  struct Candidate {
    double cost;
    int from;
    Image to;
    int changes;  ///< of both when the cost was computed

    auto operator<=>(const Candidate&) const = default;
  };
  using Triangle = std::array<Vec<3>, 3>;

  int turned(int sector) const { return (sector % mesh_.n_sectors + mesh_.n_sectors) % mesh_.n_sectors; }

  Vec<3> point(const Image& image) const {
    return rotations_[image.sector].forward(mesh_.points[image.vertex]);
  }

  /// The corners of a facet as seen from the sector of its corner at a vertex, which comes first.
  std::array<Image, 3> seen_from(int vertex, const Facet& facet) const {
    int first = 0;
    while (facet.corners[first].vertex != vertex) ++first;
    std::array<Image, 3> result;
    for (int k = 0; k < 3; ++k) {
      const Image& corner = facet.corners[(first + k) % 3];
      result[k] = {corner.vertex, turned(corner.sector - facet.corners[first].sector)};
    }
    return result;
  }

  /// The ends of the edges at a vertex of sector 0, sorted.
  std::vector<Image> neighbours(int vertex) const {
    std::vector<Image> result;
    for (const int t : at_vertex_[vertex]) result.push_back(seen_from(vertex, facets_[t])[1]);
    std::ranges::sort(result);
    return result;
  }

  bool is_edge(int from, const Image& to) const { return std::ranges::binary_search(neighbours(from), to); }

  /// Whether a vertex lies on an edge between two parts; it may then only move along this edge. Nothing if it
  /// must not move at all.
  std::optional<std::vector<Image>> ways(int vertex) const {
    std::vector<std::pair<Image, SurfacePart>> before, after;  // edges by the facets on both sides
    for (const int t : at_vertex_[vertex]) {
      const auto corners = seen_from(vertex, facets_[t]);
      before.emplace_back(corners[1], facets_[t].part);
      after.emplace_back(corners[2], facets_[t].part);
    }
    std::ranges::sort(before);
    std::ranges::sort(after);
    std::vector<Image> all, creases;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].first != after[i].first) return {};
      all.push_back(before[i].first);
      if (before[i].second != after[i].second) creases.push_back(before[i].first);
    }
    if (creases.empty()) return all;
    if (creases.size() == 2) return creases;
    return {};
  }

  /// Whether the surface stays a manifold: both ends have two common neighbours, which keep three edges.
  bool keeps_manifold(int from, const Image& to) const {
    const auto mine = neighbours(from);
    auto others = neighbours(to.vertex);
    for (Image& other : others) other.sector = turned(other.sector + to.sector);
    std::ranges::sort(others);
    std::vector<Image> common;
    std::ranges::set_intersection(mine, others, std::back_inserter(common));
    return common.size() == 2 && common[0].vertex != common[1].vertex &&
           std::ranges::all_of(common, [&](const Image& c) { return at_vertex_[c.vertex].size() > 3; });
  }

  /// The cost of moving a vertex to a neighbour [m]; nothing if it is not allowed.
  std::optional<double> cost(int from, const Image& to) const {
    if (to.vertex == from) return {};
    const auto allowed = ways(from);
    if (!allowed || std::ranges::find(*allowed, to) == allowed->end()) return {};
    if (!keeps_manifold(from, to)) return {};
    double largest = 0;
    for (const int t : at_vertex_[from]) {
      const auto corners = seen_from(from, facets_[t]);
      if (corners[1] == to || corners[2] == to) continue;
      if (corners[1].vertex == to.vertex || corners[2].vertex == to.vertex) return {};
      const auto found = deviation({point(to), point(corners[1]), point(corners[2])}, facets_[t].part);
      if (!found) return {};
      largest = std::max(largest, *found);
    }
    constexpr double cost_of_length = 1e-3;  // short edges go first where the surface is flat
    return largest + cost_of_length * norm(point(to) - mesh_.points[from]);
  }

  /// The largest distance of a triangle from its part of the surface [m]; nothing if it is not allowed.
  std::optional<double> deviation(const Triangle& corners, SurfacePart part) const {
    const Vec<3> first = corners[1] - corners[0], second = corners[2] - corners[0];
    const Vec<3> area = cross(first, second);
    const double longest =
        std::max({dot(first, first), dot(second, second), dot(second - first, second - first)});
    constexpr double thinnest = 1e-3, smallest_cosine = 0.25;
    if (!(norm(area) > thinnest * longest)) return {};
    constexpr int parts = 3;
    double largest = 0;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        const Vec<3> x = corners[0] + (double(i) / parts) * first + (double(j) / parts) * second;
        const auto [distance, normal] = at(x, part, corners[0]);
        if (!(distance <= tolerance_)) return {};
        if (!(dot(normal, area) > smallest_cosine * norm(area))) return {};
        largest = std::max(largest, distance);
      }
    return largest;
  }

  struct Nearby {
    double distance;
    Vec<3> normal;  ///< out of the material
  };
  Nearby at(const Vec<3>& x, SurfacePart part, const Vec<3>& corner) const {
    if (part == SurfacePart::hole) {
      const auto value = zero_.at(x);
      return {value.distance(), value.gradient / norm(value.gradient)};
    }
    if (part == SurfacePart::side) return {0, {0, 0, corner[2] > 0.5 * grid_.width ? 1.0 : -1.0}};
    const double r = std::hypot(x[0], x[1]), sign = part == SurfacePart::tread ? 1 : -1;
    const double radius = part == SurfacePart::tread ? grid_.outer_radius : grid_.inner_radius;
    return {std::abs(r - radius), {sign * x[0] / r, sign * x[1] / r, 0}};
  }

  template <class Queue>
  void push(int from, const Image& to, Queue& queue) const {
    if (const auto value = cost(from, to))
      queue.push({*value, from, to, changes_[from] + changes_[to.vertex]});
  }

  void merge(int from, const Image& to) {
    for (const int t : at_vertex_[from]) {
      Facet& facet = facets_[t];
      const auto seen = seen_from(from, facet);
      for (const Image& corner : facet.corners) ++changes_[corner.vertex];
      if (seen[1] == to || seen[2] == to) {
        facet.is_left = false;
        for (const Image& corner : facet.corners)
          if (corner.vertex != from) std::erase(at_vertex_[corner.vertex], t);
        continue;
      }
      Image& mine = *std::ranges::find(facet.corners, from, &Image::vertex);
      mine = {to.vertex, turned(mine.sector + to.sector)};
      at_vertex_[to.vertex].push_back(t);
    }
    at_vertex_[from].clear();
    for (const int t : at_vertex_[to.vertex])
      for (const Image& corner : facets_[t].corners) ++changes_[corner.vertex];
  }

  const SurfaceMesh& mesh_;
  PolarGrid<3> grid_;
  ZeroSurface zero_;
  double tolerance_;
  std::vector<AxleRotation> rotations_;
  std::vector<Facet> facets_;
  std::vector<std::vector<int>> at_vertex_;  ///< the facets at every vertex
  std::vector<int> changes_;                 ///< of the facets at every vertex, counted
};

}  // namespace

SurfaceMesh simplified(const SurfaceMesh& mesh, const LevelSet<3>& psi, double tolerance) {
  Simplification simplification(mesh, psi, tolerance);
  constexpr double few = 0.02;
  for (int left = mesh.sector_points();;) {
    const int removed = simplification.pass();
    left -= removed;
    if (removed <= few * left) return simplification.result();
  }
}

}  // namespace wheelwright
