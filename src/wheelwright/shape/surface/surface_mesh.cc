#include "wheelwright/shape/surface/surface_mesh.h"

#include <cmath>
#include <optional>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/surface/clipped_vertices.h"

namespace wheelwright {
namespace {

using Position = FineLattice::Position;

/// The outer face of the ring on which all these nodes lie.
std::optional<SurfacePart> outer_face(const FineLattice& lattice, const std::array<Position, 8>& nodes,
                                      const std::array<int, 3>& triangle) {
  const auto all_at = [&](int axis, int position) {
    return std::ranges::all_of(triangle, [&](int c) { return nodes[c][axis] == position; });
  };
  if (all_at(0, 0)) return SurfacePart::rim;
  if (all_at(0, lattice.cubes()[0])) return SurfacePart::tread;
  if (all_at(2, 0) || all_at(2, lattice.cubes()[2])) return SurfacePart::side;
  return {};
}

struct SectorTriangle {
  std::array<ClippedVertices::Number, 3> corners;
  SurfacePart part;
};

/// The surface of one sector, open at its faces to the neighbouring sectors.
class SectorSurface {
 public:
  explicit SectorSurface(const FineLattice& lattice) : lattice_(lattice), vertices_(lattice) {
    Position cube;
    for (cube[1] = 0; cube[1] < lattice.cubes()[1]; ++cube[1])
      for (cube[2] = 0; cube[2] < lattice.cubes()[2]; ++cube[2])
        for (cube[0] = 0; cube[0] < lattice.cubes()[0]; ++cube[0]) add_cube(cube);
  }

  const ClippedVertices& vertices() const { return vertices_; }
  const std::vector<SectorTriangle>& triangles() const { return triangles_; }

 private:
  void add_cube(const Position& cube) {
    const auto nodes = lattice_.corners(cube);
    std::array<bool, 8> is_material;
    for (int c = 0; c < 8; ++c) is_material[c] = lattice_.is_material(nodes[c]);
    for (const Tetrahedron& tetrahedron : lattice_.tetrahedra(cube)) {
      add(nodes, boundary_in(tetrahedron, is_material), SurfacePart::hole);
      for (const auto& face : faces(tetrahedron))
        if (const auto part = outer_face(lattice_, nodes, face))
          add(nodes, material_of(face, is_material), *part);
    }
  }

  void add(const std::array<Position, 8>& nodes, const ClippedPolygon& polygon, SurfacePart part) {
    std::array<ClippedVertices::Number, 4> corners;
    for (std::size_t k = 0; k < polygon.size(); ++k) corners[k] = vertices_.number(nodes, polygon[k]);
    for (std::size_t k = 2; k < polygon.size(); ++k)
      triangles_.push_back({{corners[0], corners[k - 1], corners[k]}, part});
  }

  const FineLattice& lattice_;
  ClippedVertices vertices_;
  std::vector<SectorTriangle> triangles_;
};

double area(const SurfaceMesh& mesh, const std::array<int, 3>& t) {
  const Vec<3>&a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  return 0.5 * norm(cross(b - a, c - a));
}

}  // namespace

SurfaceMesh material_surface(const LevelSet<3>& psi, int parts, int map_degree) {
  const FineLattice lattice(psi, parts, map_degree);
  const SectorSurface sector(lattice);
  const int n_sectors = lattice.grid().n_sectors;
  SurfaceMesh mesh{n_sectors, sector.vertices().places(), {}, {}, {}};
  const int n = mesh.sector_points();
  mesh.points.reserve(std::size_t(n) * n_sectors);
  mesh.triangles.reserve(sector.triangles().size() * n_sectors);
  mesh.parts.reserve(mesh.triangles.capacity());
  for (int s = 0; s < n_sectors; ++s) {
    const double angle = s * lattice.grid().sector_angle();
    for (const Vec<3>& x : sector.vertices().points()) mesh.points.push_back(rotated<3>(x, angle));
    const std::array<int, 2> first{s * n, (s + 1) % n_sectors * n};
    for (const SectorTriangle& triangle : sector.triangles()) {
      std::array<int, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[k] = first[triangle.corners[k].in_next_sector] + triangle.corners[k].vertex;
      mesh.triangles.push_back(corners);
      mesh.parts.push_back(triangle.part);
    }
  }
  return mesh;
}

double enclosed_volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot<3>(mesh.points[t[0]], cross(mesh.points[t[1]], mesh.points[t[2]])) / 6;
  return sum;
}

double surface_area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += area(mesh, t);
  return sum;
}

double surface_area(const SurfaceMesh& mesh, SurfacePart part) {
  double sum = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    if (mesh.parts[k] == part) sum += area(mesh, mesh.triangles[k]);
  return sum;
}

}  // namespace wheelwright
