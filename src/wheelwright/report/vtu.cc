#include "wheelwright/report/vtu.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/little_endian.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"

namespace wheelwright {
namespace {

/// VTK's numbers for the kinds of cells.
constexpr std::uint8_t vtk_triangle = 5, vtk_quadrilateral = 9;

template <class Number>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<float> = "Float32";
template <>
constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";

/// The arrays' bytes, which follow the XML as they are: each array behind its size.
class AppendedArrays {
 public:
  /// `begin`: bytes of other arrays that come before.
  explicit AppendedArrays(std::size_t begin) : begin_(begin) {}

  /// Adds an array; its tag for the XML. `attributes`: more of them, as in XML.
  template <class Number>
  std::string add(std::string_view name, std::string_view attributes, const std::vector<Number>& numbers) {
    const std::size_t offset = begin_ + bytes_.size();
    append_little_endian(std::uint64_t{numbers.size() * sizeof(Number)}, bytes_);
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    return fmt::format("    <DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n",
                       vtk_type<Number>, name, attributes, offset);
  }

  const std::string& bytes() const& { return bytes_; }
  std::string bytes() && { return std::move(bytes_); }

 private:
  std::size_t begin_;
  std::string bytes_;
};

constexpr std::string_view three_components = " NumberOfComponents=\"3\"";

std::string unit_attribute(std::string_view unit) { return fmt::format(" units=\"{}\"", unit); }

/// Vectors in the plane as ParaView's in space.
std::vector<float> with_zeros(const std::vector<float>& x, const std::vector<float>& y) {
  std::vector<float> vectors;
  vectors.reserve(3 * x.size());
  for (std::size_t k = 0; k < x.size(); ++k) vectors.insert(vectors.end(), {x[k], y[k], 0});
  return vectors;
}

std::vector<MaterialPolygon> triangles(const std::vector<MaterialPolygon>& polygons) {
  std::vector<MaterialPolygon> result;
  for (const MaterialPolygon& polygon : polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k)
      result.push_back({polygon[0], polygon[k - 1], polygon[k]});
  return result;
}

bool is_full(const std::vector<MaterialPolygon>& polygons) {
  return polygons.size() == 1 && polygons[0] == MaterialPolygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

}  // namespace

/// What one sector's cells are cut into; the others repeat it.
struct VtuMesh::Sector {
  struct Point {
    Vec<2> position;  ///< Cartesian, in the sector's own frame
    float psi;
    std::array<double, 9> shape;  ///< values of the fields' shape functions
  };
  /// Points that are evaluated in the same cell.
  struct Patch {
    RingCellNodes<2> nodes;  ///< of that cell in sector 0
    std::size_t end;         ///< number of the point behind its last one
  };

  std::vector<Point> points;
  std::vector<Patch> patches;
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;

  Sector(const LevelSet<2>& psi, const Lattice<2>& lattice, int cut_subdivisions)
      : psi_(psi), lattice_(lattice) {
    const auto polygons = material_polygons(psi, cut_subdivisions);
    const std::vector<MaterialPolygon> squares = parts_of_full_cell(lattice.degree());
    for (int cell = 0; cell < psi.lattice.grid().n_cells(); ++cell)
      if (is_full(polygons[cell]))
        append_cells(cell, squares, vtk_quadrilateral);
      else
        append_cells(cell, triangles(polygons[cell]), vtk_triangle);
  }

 private:
  /// The whole cell, divided by the lattice's degree.
  static std::vector<MaterialPolygon> parts_of_full_cell(int degree) {
    const auto corner = [&](int i, int j) { return Vec<2>{double(i) / degree, double(j) / degree}; };
    std::vector<MaterialPolygon> parts;
    for (int j = 0; j < degree; ++j)
      for (int i = 0; i < degree; ++i)
        parts.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    return parts;
  }

  /// Adds polygons of the unit cell, with their points that are not there yet.
  void append_cells(int cell, const std::vector<MaterialPolygon>& polygons, std::uint8_t type) {
    const auto c = lattice_.grid().cell_position(cell);
    const CellMap<2> map(lattice_.grid(), psi_.lattice.degree(), c);
    const std::vector<double> nodal = psi_.cell_values(cell);
    for (const MaterialPolygon& polygon : polygons) {
      for (const Vec<2>& xi : polygon) {
        const auto [known, is_new] =
            numbers_.try_emplace({c[0] + xi[0], c[1] + xi[1]}, static_cast<std::int32_t>(points.size()));
        if (is_new) append_point(map, c[1], nodal, xi);
        connectivity.push_back(known->second);
      }
      offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
      types.push_back(type);
    }
    patches.push_back({ring_cell_nodes<2>(lattice_, c), points.size()});
  }

  void append_point(const CellMap<2>& map, int column, const std::vector<double>& nodal, const Vec<2>& xi) {
    const ShapeFunctions<2> geometry(psi_.lattice.degree(), xi), fields(lattice_.degree(), xi);
    double value = 0;
    for (std::size_t a = 0; a < nodal.size(); ++a) value += geometry.value[a] * nodal[a];
    points.push_back({rotated<2>(map.position(geometry), column * lattice_.grid().cell_size()[1]),
                      static_cast<float>(value), fields.value});
  }

  const LevelSet<2>& psi_;
  const Lattice<2>& lattice_;
  std::map<Vec<2>, std::int32_t> numbers_;  ///< of the points, by their places in units of cells
};

VtuMesh::VtuMesh(const LevelSet<2>& psi, const Lattice<2>& lattice, int cut_subdivisions,
                 std::string_view length_unit)
    : lattice_(lattice), sector_(std::make_unique<Sector>(psi, lattice, cut_subdivisions)) {
  const int n_sectors = lattice.grid().n_sectors;
  const std::size_t n_points = sector_->points.size() * n_sectors;
  if (n_points > std::numeric_limits<std::int32_t>::max() / 3)
    throw std::length_error("a VTU file has at most 700 million points");
  std::vector<float> points, level;
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  for (int sector = 0; sector < n_sectors; ++sector) {
    const int first_point = sector * static_cast<int>(sector_->points.size());
    const int first_corner = static_cast<int>(connectivity.size());
    for (const Sector::Point& point : sector_->points) {
      const Vec<2> x = rotated<2>(point.position, sector * lattice.grid().sector_angle());
      points.insert(points.end(), {static_cast<float>(x[0]), static_cast<float>(x[1]), 0});
      level.push_back(point.psi);
    }
    for (const std::int32_t corner : sector_->connectivity) connectivity.push_back(first_point + corner);
    for (const std::int32_t offset : sector_->offsets) offsets.push_back(first_corner + offset);
    types.insert(types.end(), sector_->types.begin(), sector_->types.end());
  }
  AppendedArrays arrays(0);
  const std::string point_tags = arrays.add("Points", three_components, points),
                    cell_tags = arrays.add("connectivity", "", connectivity) +
                                arrays.add("offsets", "", offsets) + arrays.add("types", "", types),
                    psi_tag = arrays.add("psi", unit_attribute(length_unit), level);
  beginning_ = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n  <Points>\n{}  </Points>\n  <Cells>\n{}"
      "  </Cells>\n  <PointData Scalars=\"psi\">\n{}",
      n_points, types.size(), point_tags, cell_tags, psi_tag);
  arrays_ = std::move(arrays).bytes();
}

VtuMesh::~VtuMesh() = default;

std::vector<float> VtuMesh::values(const RingField& field, int component) const {
  const int n_sectors = lattice_.grid().n_sectors, n_nodes = nodes_per_cell<2>(lattice_.degree());
  const std::size_t sector_nodes = lattice_.n_nodes(), ring_nodes = sector_nodes * n_sectors;
  std::vector<float> result;
  result.reserve(sector_->points.size() * n_sectors);
  for (int sector = 0; sector < n_sectors; ++sector) {
    auto point = sector_->points.begin();
    for (const Sector::Patch& patch : sector_->patches) {
      std::array<double, 9> nodal;
      for (int a = 0; a < n_nodes; ++a) {
        const std::size_t node = (patch.nodes[a] + sector * sector_nodes) % ring_nodes;
        nodal[a] = field.values[component + field.components * node];
      }
      for (; point != sector_->points.begin() + patch.end; ++point)
        result.push_back(static_cast<float>(
            std::inner_product(nodal.begin(), nodal.begin() + n_nodes, point->shape.begin(), 0.0)));
    }
  }
  return result;
}

std::string VtuMesh::file(std::span<const NamedField> fields) const {
  AppendedArrays arrays(arrays_.size());
  std::string tags;
  for (const auto& [name, unit, field] : fields)
    if (field.components == 2)
      tags += arrays.add(name, std::string(three_components) + unit_attribute(unit),
                         with_zeros(values(field, 0), values(field, 1)));
    else
      for (int c = 0; c < field.components; ++c)
        tags += arrays.add(field.components == 1 ? name : fmt::format("{}_{}", name, c), unit_attribute(unit),
                           values(field, c));
  return beginning_ + tags +
         "  </PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + arrays_ +
         arrays.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

void VtuMesh::write(const std::filesystem::path& path, std::span<const NamedField> fields) const {
  write_atomically(path, file(fields));
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries) {
  std::string content =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const PvdEntry& e : entries)
    content += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", e.time, e.file);
  content += "  </Collection>\n</VTKFile>\n";
  write_atomically(path, content);
}

}  // namespace wheelwright
