#include "wheelwright/output/report/surface_vtp.h"

#include "wheelwright/output/report/vtu_arrays.h"

namespace wheelwright {

FieldPoints<3> field_points(const SurfaceMesh& surface, const Lattice<3>& lattice) {
  FieldPoints<3> points(lattice);
  for (const CellPoint& place : surface.places) points.add(place.cell, place.xi);
  return points;
}

std::string surface_vtp(const SurfaceMesh& surface, const Lattice<3>& lattice,
                        std::span<const NamedField> fields) {
  std::vector<float> points;
  for (const Vec<3>& x : surface.points)
    for (const double coordinate : x) points.push_back(static_cast<float>(coordinate));
  std::vector<std::int32_t> connectivity, offsets;
  for (const auto& triangle : surface.triangles) {
    connectivity.insert(connectivity.end(), triangle.begin(), triangle.end());
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  std::vector<std::uint8_t> parts;
  for (const SurfacePart part : surface.parts) parts.push_back(static_cast<std::uint8_t>(part));
  AppendedArrays arrays(0);
  const std::string mesh = add_surface(points, connectivity, offsets, arrays);
  std::string tags;
  if (!fields.empty()) {
    const FieldPoints<3> vertices = field_points(surface, lattice);
    for (const NamedField& field : fields) tags += add_field(field, vertices, arrays);
  }
  const std::string part_tag = arrays.add("part", 1, parts);
  return vtp_beginning(surface.points.size(), surface.triangles.size(), mesh) + tags +
         vtp_end(part_tag, arrays.bytes());
}

}  // namespace wheelwright
