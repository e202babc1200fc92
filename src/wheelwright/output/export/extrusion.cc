#include "wheelwright/output/export/extrusion.h"

#include "wheelwright/cad/outline/triangulation.h"

namespace wheelwright {
namespace {

std::array<float, 3> in_millimetres(const Vec<2>& p, double z) {
  return {static_cast<float>(p[0] * millimetres_per_metre), static_cast<float>(p[1] * millimetres_per_metre),
          static_cast<float>(z * millimetres_per_metre)};
}

}  // namespace

SolidMesh solid_mesh(const WheelModel& wheel) {
  std::vector<cad::Polygon> polygons;
  for (const cad::Loop& loop : wheel.outline.loops) polygons.push_back(cad::flattened(loop, wheel.tolerance));
  const cad::Triangulation plane = cad::triangulated(polygons);
  const int n = static_cast<int>(plane.points.size());
  SolidMesh mesh;
  for (const double z : {0.0, wheel.width})
    for (const Vec<2>& p : plane.points) mesh.points.push_back(in_millimetres(p, z));
  for (const auto& [a, b, c] : plane.triangles) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({n + a, n + b, n + c});
  }
  int first = 0;
  for (const cad::Polygon& polygon : polygons) {
    const int size = static_cast<int>(polygon.size());
    for (int i = 0; i < size; ++i) {
      const int a = first + i, b = first + (i + 1) % size;  // the material is on the left
      mesh.triangles.push_back({a, b, n + b});
      mesh.triangles.push_back({a, n + b, n + a});
    }
    first += size;
  }
  return mesh;
}

}  // namespace wheelwright
