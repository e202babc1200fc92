#include "wheelwright/output/report/solid_mesh.h"

#include <cmath>
#include <cstdint>

#include "wheelwright/base/text.h"
#include "wheelwright/files/little_endian.h"

namespace wheelwright {
namespace {

using Point = std::array<float, 3>;

Point unit_normal(const Point& a, const Point& b, const Point& c) {
  const double u[] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double n[] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

void append(const Point& point, std::string& bytes) {
  for (const float x : point) append_little_endian(x, bytes);
}

}  // namespace

SolidMesh solid_mesh(const SurfaceMesh& surface) {
  constexpr double millimetres_per_metre = 1e3;
  SolidMesh mesh{{}, surface.triangles};
  mesh.points.reserve(surface.points.size());
  for (const Vec<3>& x : surface.points) {
    mesh.points.emplace_back();
    for (int d = 0; d < 3; ++d) mesh.points.back()[d] = static_cast<float>(millimetres_per_metre * x[d]);
  }
  return mesh;
}

Expected<SurfaceReport, SurfaceFault> check_solid(const SolidMesh& mesh) {
  std::vector<Vec<3>> points;
  points.reserve(mesh.points.size());
  for (const Point& p : mesh.points) points.push_back({p[0], p[1], p[2]});
  return check_surface(points, mesh.triangles);
}

std::string stl_file(const SolidMesh& mesh, std::string_view header) {
  constexpr std::size_t header_size = 80, bytes_per_triangle = 50;
  // A header that starts with "solid" would indicate a text file.
  std::string bytes = without_control_characters(header);
  bytes.resize(header_size, ' ');
  bytes.reserve(header_size + 4 + bytes_per_triangle * mesh.triangles.size());
  append_little_endian(static_cast<std::uint32_t>(mesh.triangles.size()), bytes);
  for (const auto& [a, b, c] : mesh.triangles) {
    append(unit_normal(mesh.points[a], mesh.points[b], mesh.points[c]), bytes);
    for (const int corner : {a, b, c}) append(mesh.points[corner], bytes);
    append_little_endian(std::uint16_t{0}, bytes);
  }
  return bytes;
}

}  // namespace wheelwright
