#include "wheelwright/output/report/vtu_arrays.h"

#include <fmt/format.h>

#include <array>
#include <cassert>

namespace wheelwright {
namespace {

constexpr std::array<const char*, 6> tensor_components{"xx", "yy", "zz", "xy", "yz", "xz"};

/// The selected components, interleaved by point; a negative index gives 0.
template <std::size_t n>
std::vector<float> interleaved(const std::vector<std::vector<float>>& components,
                               const std::array<int, n>& shown) {
  std::vector<float> result(n * components[0].size());
  for (std::size_t c = 0; c < n; ++c) {
    if (shown[c] < 0) continue;
    const std::vector<float>& values = components[shown[c]];
    for (std::size_t k = 0; k < values.size(); ++k) result[c + n * k] = values[k];
  }
  return result;
}

}  // namespace

std::string AppendedArrays::tag(const char* type, std::string_view name, int components, std::size_t offset) {
  std::string attributes;
  if (components > 1) attributes = fmt::format(" NumberOfComponents=\"{}\"", components);
  if (components == static_cast<int>(tensor_components.size()))
    for (int c = 0; c < components; ++c)
      attributes += fmt::format(" ComponentName{}=\"{}\"", c, tensor_components[c]);
  return fmt::format("    <DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
                     name, attributes, offset);
}

std::string add_mesh(const std::vector<float>& points, const std::vector<std::int32_t>& connectivity,
                     const std::vector<std::int32_t>& offsets, const std::vector<std::uint8_t>& types,
                     AppendedArrays& arrays) {
  const std::string point_tag = arrays.add("Points", 3, points),
                    cell_tags = arrays.add("connectivity", 1, connectivity) +
                                arrays.add("offsets", 1, offsets) + arrays.add("types", 1, types);
  return fmt::format("  <Points>\n{}  </Points>\n  <Cells>\n{}  </Cells>\n", point_tag, cell_tags);
}

std::string add_field(const std::string& name, const std::vector<std::vector<float>>& components,
                      AppendedArrays& arrays) {
  switch (components.size()) {
    case 1:
      return arrays.add(name, 1, components[0]);
    case 2:
      return arrays.add(name, 3, interleaved<3>(components, {0, 1, -1}));
    case 3:
      return arrays.add(name, 3, interleaved<3>(components, {0, 1, 2}));
    case 4:
      return arrays.add(name, 6, interleaved<6>(components, {0, 1, 2, 3, -1, -1}));
    default:
      assert(components.size() == 6);
      return arrays.add(name, 6, interleaved<6>(components, {0, 1, 2, 3, 4, 5}));
  }
}

template <int dim>
std::string add_field(const NamedField& field, const FieldPoints<dim>& points, AppendedArrays& arrays) {
  if (field.scalar) return add_field(vtu_name(field.name, field.unit), points.values(field), arrays);
  const auto components = points.components(field.field);
  std::string tags = add_field(vtu_name(field.name, field.unit), components, arrays);
  for (const NamedScalar& scalar : field.beside)
    tags += add_field(vtu_name(scalar.name, scalar.unit), {scalars(components, scalar.of)}, arrays);
  return tags;
}

template decltype(add_field<2>) add_field<2>;
template decltype(add_field<3>) add_field<3>;

std::string vtu_name(std::string_view name, std::string_view unit) {
  return fmt::format("{}_{}", name, unit);
}

std::string vtu_beginning(std::size_t n_points, std::size_t n_cells, std::string_view mesh_tags) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n{}  <PointData>\n",
      n_points, n_cells, mesh_tags);
}

std::string add_surface(const std::vector<float>& points, const std::vector<std::int32_t>& connectivity,
                        const std::vector<std::int32_t>& offsets, AppendedArrays& arrays) {
  const std::string point_tag = arrays.add("Points", 3, points),
                    polygon_tags =
                        arrays.add("connectivity", 1, connectivity) + arrays.add("offsets", 1, offsets);
  return fmt::format("  <Points>\n{}  </Points>\n  <Polys>\n{}  </Polys>\n", point_tag, polygon_tags);
}

std::string vtp_beginning(std::size_t n_points, std::size_t n_polygons, std::string_view mesh_tags) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n{}  <PointData>\n",
      n_points, n_polygons, mesh_tags);
}

std::string vtp_end(std::string_view polygon_fields, const std::string& arrays) {
  return fmt::format("  </PointData>\n  <CellData>\n{}  </CellData>\n", polygon_fields) +
         "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + arrays +
         "\n</AppendedData>\n</VTKFile>\n";
}

std::vector<std::string_view> vtu_parts(std::string_view beginning,
                                        std::initializer_list<std::string_view> arrays) {
  std::vector<std::string_view> parts{
      beginning, "  </PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_"};
  parts.insert(parts.end(), arrays);
  parts.push_back("\n</AppendedData>\n</VTKFile>\n");
  return parts;
}

}  // namespace wheelwright
