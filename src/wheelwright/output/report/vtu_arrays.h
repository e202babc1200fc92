#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/files/little_endian.h"
#include "wheelwright/output/report/field_points.h"

namespace wheelwright {

/// VTK's numbers for the kinds of cells.
inline constexpr std::uint8_t vtk_line = 3, vtk_triangle = 5, vtk_quadrilateral = 9, vtk_tetrahedron = 10,
                              vtk_hexahedron = 12, vtk_wedge = 13;

template <class Number>
inline constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<float> = "Float32";
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";

/// The bytes of a VTU file's arrays, appended to the XML in raw form: each array after its size.
class AppendedArrays {
 public:
  /// `begin`: number of preceding bytes of other arrays.
  explicit AppendedArrays(std::size_t begin) : begin_(begin) {}

  /// Adds an array of vectors with that many components; its tag for the XML.
  template <class Number>
  std::string add(std::string_view name, int components, const std::vector<Number>& numbers) {
    const std::size_t offset = begin_ + bytes_.size();
    append_little_endian(std::uint64_t{numbers.size() * sizeof(Number)}, bytes_);
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    return tag(vtk_type<Number>, name, components, offset);
  }

  const std::string& bytes() const& { return bytes_; }
  std::string bytes() && { return std::move(bytes_); }

 private:
  static std::string tag(const char* type, std::string_view name, int components, std::size_t offset);

  std::size_t begin_;
  std::string bytes_;
};

/// Adds points (x, y, z alternating) and cells; returns their tags.
std::string add_mesh(const std::vector<float>& points, const std::vector<std::int32_t>& connectivity,
                     const std::vector<std::int32_t>& offsets, const std::vector<std::uint8_t>& types,
                     AppendedArrays& arrays);

/// Adds a field at the points, given by components: a scalar, a vector (2 or 3 components), or a symmetric
/// tensor (xx, yy, zz, xy, and in 3D yz and xz). ParaView's vectors have 3 components, its symmetric tensors
/// xx, yy, zz, xy, yz and xz.
std::string add_field(const std::string& name, const std::vector<std::vector<float>>& components,
                      AppendedArrays& arrays);

/// Adds a field and the scalars beside it.
template <int dim>
std::string add_field(const NamedField& field, const FieldPoints<dim>& points, AppendedArrays& arrays);

/// A field's name in files, followed by the unit as a word.
std::string vtu_name(std::string_view name, std::string_view unit);

/// Adds points and the polygons of a surface, for a VTP file; their tags.
std::string add_surface(const std::vector<float>& points, const std::vector<std::int32_t>& connectivity,
                        const std::vector<std::int32_t>& offsets, AppendedArrays& arrays);

/// The XML of a VTP file before the fields at the points, between them and those of the polygons, and what
/// follows.
std::string vtp_beginning(std::size_t n_points, std::size_t n_polygons, std::string_view mesh_tags);
std::string vtp_end(std::string_view polygon_fields, const std::string& arrays);

/// The XML of a VTU file before the tags of the fields.
std::string vtu_beginning(std::size_t n_points, std::size_t n_cells, std::string_view mesh_tags);
/// The file in parts that follow each other: its XML with these tags, and its arrays, which must outlive
/// them.
std::vector<std::string_view> vtu_parts(std::string_view beginning,
                                        std::initializer_list<std::string_view> arrays);

}  // namespace wheelwright
