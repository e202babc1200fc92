#include "wheelwright/export/stl.h"

#include <cmath>
#include <cstdint>

#include "wheelwright/base/text.h"
#include "wheelwright/export/solid_mesh.h"
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

std::string stl(const WheelModel& wheel) {
  constexpr std::size_t header = 80, bytes_per_triangle = 50;
  const SolidMesh mesh = solid_mesh(wheel);
  // A header that begins with "solid" would be taken for that of a text file.
  std::string bytes = without_control_characters(wheel.program + ", millimetres: " + wheel.title);
  bytes.resize(header, ' ');
  bytes.reserve(header + 4 + bytes_per_triangle * mesh.triangles.size());
  append_little_endian(static_cast<std::uint32_t>(mesh.triangles.size()), bytes);
  for (const auto& [a, b, c] : mesh.triangles) {
    append(unit_normal(mesh.points[a], mesh.points[b], mesh.points[c]), bytes);
    for (const int corner : {a, b, c}) append(mesh.points[corner], bytes);
    append_little_endian(std::uint16_t{0}, bytes);
  }
  return bytes;
}

}  // namespace wheelwright
