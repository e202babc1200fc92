#include "wheelwright/shape/surface/axial_angles.h"

#include <cmath>
#include <limits>

namespace wheelwright {
namespace {

/// The triangles of holes around a vertex.
struct Fan {
  Vec<3> facing{};  ///< sum of their areas times normals, whose z is positive where they face the right way
  double area = 0;
};

/// The smallest angle by which the surface of holes faces the way along the axle that direction(z) gives, 1
/// or -1, for triangles with their middle at z. Slivers, whose normals are rounding, count by their areas.
template <class Direction>
AxialAngle smallest_angle(const SurfaceMesh& mesh, Direction direction) {
  constexpr double least_area = 0.5;  // of a fan, in units of the mean area of a triangle
  std::vector<Fan> fans(mesh.points.size());
  double total = 0;
  int n = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.parts[t] != SurfacePart::hole) continue;
    const auto& [i, j, k] = mesh.triangles[t];
    const Vec<3>&a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    Vec<3> facing = 0.5 * cross(b - a, c - a);
    facing[2] *= direction((a[2] + b[2] + c[2]) / 3);
    const double area = norm<3>(facing);
    total += area;
    ++n;
    for (const int vertex : {i, j, k}) {
      fans[vertex].facing += facing;
      fans[vertex].area += area;
    }
  }
  AxialAngle result{std::numeric_limits<double>::infinity(), {}};
  for (std::size_t vertex = 0; vertex < fans.size(); ++vertex) {
    const Fan& fan = fans[vertex];
    if (fan.area == 0 || fan.area < least_area * total / n) continue;
    const double angle = std::asin(fan.facing[2] / norm<3>(fan.facing));
    if (angle < result.angle) result = {angle, polar<3>(mesh.points[vertex])};
  }
  return result;
}

}  // namespace

AxialAngle smallest_draft(const SurfaceMesh& mesh, double parting_plane) {
  return smallest_angle(mesh, [&](double z) { return z > parting_plane ? 1 : -1; });
}

AxialAngle largest_overhang(const SurfaceMesh& mesh, SideFace plate) {
  auto result = smallest_angle(mesh, [&](double) { return plate == SideFace::smaller_z ? 1 : -1; });
  result.angle = -result.angle;
  return result;
}

}  // namespace wheelwright
