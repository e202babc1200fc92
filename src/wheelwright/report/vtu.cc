#include "wheelwright/report/vtu.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"
#include "wheelwright/report/vtu_arrays.h"

namespace wheelwright {
namespace {

std::vector<MaterialPolygon> triangles(const std::vector<MaterialPolygon>& polygons) {
  std::vector<MaterialPolygon> result;
  for (const MaterialPolygon& polygon : polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k)
      result.push_back({polygon[0], polygon[k - 1], polygon[k]});
  return result;
}

/// The scalar of the components at every point.
std::vector<float> scalars(const std::vector<std::vector<float>>& components,
                           const std::function<double(std::span<const double>)>& scalar) {
  std::vector<float> result;
  std::vector<double> at_point(components.size());
  for (std::size_t k = 0; k < components[0].size(); ++k) {
    for (std::size_t c = 0; c < components.size(); ++c) at_point[c] = components[c][k];
    result.push_back(static_cast<float>(scalar(at_point)));
  }
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
  beginning_ = vtu_beginning(n_points, types.size(), add_mesh(points, connectivity, offsets, types, arrays)) +
               arrays.add(vtu_name("psi", length_unit), 1, level);
  arrays_ = std::move(arrays).bytes();
}

VtuMesh::~VtuMesh() = default;

std::vector<std::vector<float>> VtuMesh::values(const RingField& field) const {
  std::vector<std::vector<float>> components;
  for (int c = 0; c < field.components; ++c) components.push_back(values(field, c));
  return components;
}

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
  for (const NamedField& field : fields) {
    auto components = values(field.field);
    if (field.scalar) components = {scalars(components, field.scalar)};
    tags += add_field(vtu_name(field.name, field.unit), components, arrays);
  }
  return beginning_ + tags + vtu_end(arrays_ + arrays.bytes());
}

void VtuMesh::write(const std::filesystem::path& path, std::span<const NamedField> fields) const {
  write_atomically(path, file(fields));
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries) {
  std::string content =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const PvdEntry& e : entries)
    content += fmt::format("    <DataSet timestep=\"{:.12g}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                           e.time, e.part, e.name, e.file);
  content += "  </Collection>\n</VTKFile>\n";
  write_atomically(path, content);
}

}  // namespace wheelwright
