#include "wheelwright/shape/surface/faceted_solid.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "wheelwright/shape/surface/sides.h"

namespace wheelwright {
namespace {

/// Whether a part ends at side faces only.
bool is_cylinder(const Sides& sides, SurfacePart part) {
  bool exists = false;
  for (int side = 0; side < sides.count(); ++side) {
    if (sides.part(side) != part) continue;
    exists = true;
    if (sides.is_border(side) && sides.part_beyond(side) != SurfacePart::side) return false;
  }
  return exists;
}

/// The connected piece of the surface to which every triangle belongs.
std::vector<int> shells(const Sides& sides) {
  return sides.pieces([](int) { return true; });
}

/// The connected side face to which every triangle of side faces belongs.
std::vector<int> side_faces(const Sides& sides) {
  return sides.pieces([&](int side) { return !sides.is_border(side); });
}

void add_side_faces(const SurfaceMesh& mesh, const Sides& sides, const std::vector<int>& shell,
                    FacetedSolid& solid) {
  const std::vector<int> face_of = side_faces(sides);
  std::map<int, FacetedSolid::SideFace> faces;
  std::vector<bool> is_done(sides.count(), false);
  for (int side = 0; side < sides.count(); ++side) {
    if (sides.part(side) != SurfacePart::side || !sides.is_border(side) || is_done[side]) continue;
    const bool is_last = mesh.points[sides.from(side)][2] > 0.5 * solid.width;
    auto& face = faces
                     .try_emplace(face_of[side / 3],
                                  FacetedSolid::SideFace{is_last, false, false, {}, shell[side / 3]})
                     .first->second;
    std::vector<int> polygon;
    for (const int s : sides.border(side)) {
      is_done[s] = true;
      polygon.push_back(sides.from(s));
    }
    if (sides.part_beyond(side) == SurfacePart::rim && solid.has_rim_cylinder)
      face.ends_at_rim = true;
    else if (sides.part_beyond(side) == SurfacePart::tread && solid.has_tread_cylinder)
      face.ends_at_tread = true;
    else
      face.polygons.push_back(std::move(polygon));
  }
  for (auto& [number, face] : faces) solid.side_faces.push_back(std::move(face));
}

}  // namespace

FacetedSolid faceted_solid(const SurfaceMesh& mesh, double inner_radius, double outer_radius, double width) {
  const Sides sides(mesh);
  const std::vector<int> shell = shells(sides);
  FacetedSolid solid{.inner_radius = inner_radius,
                     .outer_radius = outer_radius,
                     .width = width,
                     .has_rim_cylinder = is_cylinder(sides, SurfacePart::rim),
                     .has_tread_cylinder = is_cylinder(sides, SurfacePart::tread),
                     .shell_of_rim = -1,
                     .shell_of_tread = -1,
                     .n_shells = 1 + *std::ranges::max_element(shell),
                     .points = mesh.points,
                     .side_faces = {},
                     .triangles = {}};
  add_side_faces(mesh, sides, shell, solid);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const SurfacePart part = mesh.parts[t];
    if (part == SurfacePart::rim && solid.has_rim_cylinder)
      solid.shell_of_rim = shell[t];
    else if (part == SurfacePart::tread && solid.has_tread_cylinder)
      solid.shell_of_tread = shell[t];
    else if (part != SurfacePart::side)
      solid.triangles.push_back({mesh.triangles[t], shell[t]});
  }
  return solid;
}

double enclosed_volume(const FacetedSolid& solid) {
  // By the divergence of (x, y, 0) / 2, to which faces across the axle contribute nothing.
  const auto disc = [&](double radius) { return std::numbers::pi * radius * radius * solid.width; };
  double volume = (solid.has_tread_cylinder ? disc(solid.outer_radius) : 0) -
                  (solid.has_rim_cylinder ? disc(solid.inner_radius) : 0);
  for (const auto& triangle : solid.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Vec<3> twice = cross(solid.points[b] - solid.points[a], solid.points[c] - solid.points[a]);
    const Vec<3> middle = (solid.points[a] + solid.points[b] + solid.points[c]) / 3.0;
    volume += 0.25 * (middle[0] * twice[0] + middle[1] * twice[1]);
  }
  return volume;
}

}  // namespace wheelwright
