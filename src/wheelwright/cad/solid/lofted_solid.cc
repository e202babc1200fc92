#include "wheelwright/cad/solid/lofted_solid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright::cad {
namespace {

constexpr double pi = std::numbers::pi;

/// An edge of a hole: sides of its triangles in the order of the surface.
struct MeshEdge {
  std::vector<int> sides;
  int piece;  ///< of the hole's surface
  bool is_last_face;
};

double twice_area(const SurfaceMesh& mesh, const Sides& sides, const std::vector<int>& edge) {
  double sum = 0;
  for (const int side : edge) sum += cross(mesh.points[sides.from(side)], mesh.points[sides.to(side)])[2];
  return sum;
}

/// The centroid of the area within an edge.
Vec<2> centroid(const SurfaceMesh& mesh, const Sides& sides, const std::vector<int>& edge) {
  Vec<2> sum{};
  double area = 0;
  for (const int side : edge) {
    const Vec<3>&a = mesh.points[sides.from(side)], &b = mesh.points[sides.to(side)];
    const double twice = cross(Vec<2>{a[0], a[1]}, Vec<2>{b[0], b[1]});
    sum += twice / 3 * Vec<2>{a[0] + b[0], a[1] + b[1]};
    area += twice;
  }
  return sum / area;
}

/// Whether an edge runs around the axle.
bool is_around_axle(const SurfaceMesh& mesh, const Sides& sides, const std::vector<int>& edge) {
  double turned = 0;
  for (const int side : edge) {
    const Vec<3>&a = mesh.points[sides.from(side)], &b = mesh.points[sides.to(side)];
    turned += std::atan2(cross(Vec<2>{a[0], a[1]}, Vec<2>{b[0], b[1]}), a[0] * b[0] + a[1] * b[1]);
  }
  return std::abs(turned) > pi;
}

class Lofting {
 public:
  Lofting(const SurfaceMesh& mesh, const LevelSet<3>& psi, double tolerance)
      : mesh_(mesh),
        grid_(psi.lattice.grid()),
        zero_(psi),
        tolerance_(tolerance),
        sides_(mesh),
        piece_(sides_.pieces([&](int side) { return !sides_.is_border(side); })) {}

  Expected<LoftedSolid, std::string> solid() {
    const FacetedSolid faces = faceted_solid(mesh_, grid_.inner_radius, grid_.outer_radius, grid_.width);
    if (faces.n_shells != 1) return std::string("it has several bodies or closed cavities");
    if (!faces.has_rim_cylinder || !faces.has_tread_cylinder) return std::string("holes reach rim or tread");
    find_edges();
    LoftedSolid result{grid_.inner_radius, grid_.outer_radius, grid_.width, {}, {}};
    if (const std::string why = add_holes(result); !why.empty()) return why;
    for (const auto& face : faces.side_faces) add(face, result);
    return result;
  }

 private:
  void find_edges() {
    std::vector<bool> is_done(sides_.count(), false);
    for (int side = 0; side < sides_.count(); ++side) {
      if (sides_.part(side) != SurfacePart::hole || !sides_.is_border(side) || is_done[side]) continue;
      MeshEdge edge{sides_.border(side), piece_[side / 3],
                    mesh_.points[sides_.from(side)][2] > 0.5 * grid_.width};
      for (const int s : edge.sides) {
        is_done[s] = true;
        edge_at_[sides_.from(s)] = static_cast<int>(edges_.size());
      }
      edges_of_[edge.piece].push_back(static_cast<int>(edges_.size()));
      edges_.push_back(std::move(edge));
    }
  }

  /// Adds the surface of every piece, those of other sectors as images; returns why that is impossible.
  std::string add_holes(LoftedSolid& solid) {
    const std::size_t per_sector = mesh_.triangles.size() / mesh_.n_sectors;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (mesh_.parts[t] != SurfacePart::hole || hole_of_.contains(piece_[t])) continue;
      hole_of_[piece_[t]] = static_cast<int>(solid.holes.size());
      const std::size_t sector = t / per_sector;
      const int original = piece_[t % per_sector];
      if (sector > 0 && original != piece_[t]) {
        const auto& model = solid.holes[hole_of_.at(original)];
        copy_edges(original, piece_[t], sector);
        solid.holes.push_back({rotated(model.surface, sector * grid_.sector_angle()), model.faces_out});
        continue;
      }
      const auto surface = lofted(piece_[t]);
      if (!surface) return surface.failure();
      solid.holes.push_back({*surface, faces_out(*surface)});
    }
    return {};
  }

  /// Puts the edges of an image into the order of those of its original.
  void copy_edges(int original, int image, std::size_t sector) {
    std::vector<int> ordered;
    for (const int edge : edges_of_.at(original)) {
      const int vertex = sides_.from(edges_[edge].sides.front());
      ordered.push_back(edge_at_.at((vertex + static_cast<int>(sector) * mesh_.sector_points()) %
                                    static_cast<int>(mesh_.points.size())));
    }
    edges_of_[image] = ordered;
  }

  Expected<SplineSurface, std::string> lofted(int piece) {
    const auto& edges = edges_of_[piece];
    if (edges.empty() || edges.size() > 2)
      return std::string("the surface of a hole branches, it has " + std::to_string(edges.size()) +
                         " edges in side faces");
    const MeshEdge& first = edges_[edges[0]];
    const bool is_groove = is_around_axle(mesh_, sides_, first.sides);
    HolePiece hole{
        mesh_, sides_, first.sides, {}, is_groove ? Vec<2>{} : centroid(mesh_, sides_, first.sides)};
    if (edges.size() == 2) {
      const MeshEdge& other = edges_[edges[1]];
      hole.other = other.sides;
      if (is_groove != is_around_axle(mesh_, sides_, other.sides) ||
          (!is_groove && first.is_last_face == other.is_last_face))
        return std::string("the surface of a hole is neither a groove around the axle nor a through hole");
      if (!is_groove) hole.axis = 0.5 * (hole.axis + centroid(mesh_, sides_, other.sides));
    }
    return lofted_hole(hole, zero_, tolerance_);
  }

  bool faces_out(const SplineSurface& surface) const {
    const SurfaceJet jet = at(surface, 0.5, 0.5);
    return dot(cross(jet.by_u, jet.by_v), zero_.at(jet.position).gradient) > 0;
  }

  void add(const FacetedSolid::SideFace& face, LoftedSolid& solid) const {
    LoftedSolid::SideFace result{face.is_last, face.ends_at_rim, face.ends_at_tread, {}};
    for (const auto& polygon : face.polygons) {
      const int number = edge_at_.at(polygon.front());
      const MeshEdge& edge = edges_[number];
      // The side face runs along the edge in the opposite direction.
      result.edges.push_back({hole_of_.at(edge.piece), edges_of_.at(edge.piece).front() != number,
                              twice_area(mesh_, sides_, edge.sides) < 0});
    }
    solid.side_faces.push_back(std::move(result));
  }

  const SurfaceMesh& mesh_;
  PolarGrid<3> grid_;
  ZeroSurface zero_;
  double tolerance_;
  Sides sides_;
  std::vector<int> piece_;  ///< of every triangle
  std::vector<MeshEdge> edges_;
  std::map<int, int> edge_at_;                ///< by vertex
  std::map<int, std::vector<int>> edges_of_;  ///< by piece; v = 0 is at the first one
  std::map<int, int> hole_of_;                ///< by piece
};

}  // namespace

Expected<LoftedSolid, std::string> lofted_solid(const SurfaceMesh& mesh, const LevelSet<3>& psi,
                                                double tolerance) {
  return Lofting(mesh, psi, tolerance).solid();
}

double enclosed_volume(const LoftedSolid& solid) {
  // By the divergence of (x, y, 0) / 2, to which faces across the axle contribute nothing.
  double volume =
      pi * solid.width * (solid.outer_radius * solid.outer_radius - solid.inner_radius * solid.inner_radius);
  const auto rule = unit_cell_rule<2>(4);
  for (const auto& [surface, faces_out] : solid.holes) {
    double sum = 0;
    for (int i = 0; i < surface.columns; ++i)
      for (int j = 0; j < surface.rows; ++j)
        for (const auto& [xi, weight] : rule) {
          const SurfaceJet jet = at(surface, i + xi[0], j + xi[1]);
          const Vec<3> normal = cross(jet.by_u, jet.by_v);
          sum += 0.5 * weight * (jet.position[0] * normal[0] + jet.position[1] * normal[1]);
        }
    volume += faces_out ? sum : -sum;
  }
  return volume;
}

}  // namespace wheelwright::cad
