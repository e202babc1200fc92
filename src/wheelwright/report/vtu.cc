#include "wheelwright/report/vtu.h"

#include <fmt/format.h>
#include <zlib.h>

#include <limits>
#include <stdexcept>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"

namespace wheelwright {
namespace {

/// VTK's numbers for the kinds of cells.
constexpr std::uint8_t vtk_triangle = 5, vtk_quadrilateral = 9;

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Numbers as VTK's inline binary data: a header of four counts, then one block, compressed.
template <class Number>
std::string encoded(const std::vector<Number>& numbers) {
  const uLong size = numbers.size() * sizeof(Number);
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("the arrays of a VTU file hold at most 4 GB");
  std::string block(compressBound(size), '\0');
  uLong compressed_size = block.size();
  if (compress2(reinterpret_cast<Bytef*>(block.data()), &compressed_size,
                reinterpret_cast<const Bytef*>(numbers.data()), size, Z_BEST_SPEED) != Z_OK)
    throw std::bad_alloc();
  block.resize(compressed_size);
  const std::uint32_t header[] = {1, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size),
                                  static_cast<std::uint32_t>(compressed_size)};
  return base64({reinterpret_cast<const char*>(header), sizeof header}) + base64(block);
}

template <class Number>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<float> = "Float32";
template <>
constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";

/// One array; `attributes`: more of them, as in XML.
template <class Number>
std::string data_array(std::string_view name, std::string_view attributes,
                       const std::vector<Number>& numbers) {
  return fmt::format("    <DataArray type=\"{}\" Name=\"{}\"{} format=\"binary\">\n{}\n    </DataArray>\n",
                     vtk_type<Number>, name, attributes, encoded(numbers));
}

constexpr std::string_view three_components = " NumberOfComponents=\"3\"";

std::string unit_attribute(std::string_view unit) { return fmt::format(" units=\"{}\"", unit); }

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
  struct Patch {
    int cell;
    std::size_t end;  ///< number of the point behind its last one
  };

  std::vector<Point> points;
  std::vector<Patch> patches;
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;

  Sector(const LevelSet<2>& psi, const Lattice<2>& lattice, int cut_subdivisions) {
    const auto polygons = material_polygons(psi, cut_subdivisions);
    for (int cell = 0; cell < psi.lattice.grid().n_cells(); ++cell) {
      if (is_full(polygons[cell]))
        append_full_cell(psi, lattice, cell);
      else
        for (const MaterialPolygon& polygon : polygons[cell])
          for (std::size_t k = 2; k < polygon.size(); ++k) {
            append_cell({0, 1, 2}, vtk_triangle);
            append_points(psi, lattice, cell, {polygon[0], polygon[k - 1], polygon[k]});
          }
    }
  }

 private:
  /// The whole cell, divided by the lattice's degree.
  void append_full_cell(const LevelSet<2>& psi, const Lattice<2>& lattice, int cell) {
    const int n = lattice.degree();
    std::vector<Vec<2>> xi;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) xi.push_back({double(i) / n, double(j) / n});
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int corner = i + (n + 1) * j;
        append_cell({corner, corner + 1, corner + n + 2, corner + n + 1}, vtk_quadrilateral);
      }
    append_points(psi, lattice, cell, xi);
  }

  /// A cell whose corners are points that are still to come, counted from the next one.
  void append_cell(std::initializer_list<int> corners, std::uint8_t type) {
    for (const int corner : corners)
      connectivity.push_back(static_cast<std::int32_t>(points.size()) + corner);
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    types.push_back(type);
  }

  void append_points(const LevelSet<2>& psi, const Lattice<2>& lattice, int cell,
                     const std::vector<Vec<2>>& xi) {
    const PolarGrid<2>& grid = lattice.grid();
    const auto c = grid.cell_position(cell);
    const CellMap<2> map(grid, psi.lattice.degree(), c);
    const std::vector<double> nodal = psi.cell_values(cell);
    for (const Vec<2>& x : xi) {
      const ShapeFunctions<2> geometry(psi.lattice.degree(), x), fields(lattice.degree(), x);
      double value = 0;
      for (std::size_t a = 0; a < nodal.size(); ++a) value += geometry.value[a] * nodal[a];
      points.push_back({rotated<2>(map.position(geometry), c[1] * grid.cell_size()[1]),
                        static_cast<float>(value), fields.value});
    }
    patches.push_back({cell, points.size()});
  }
};

VtuMesh::VtuMesh(const LevelSet<2>& psi, const Lattice<2>& lattice, int cut_subdivisions)
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
  beginning_ = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" compressor=\"vtkZLibDataCompressor\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n  <Points>\n{}  </Points>\n  <Cells>\n{}{}{}"
      "  </Cells>\n  <PointData Scalars=\"psi\">\n{}",
      n_points, types.size(), data_array("Points", three_components, points),
      data_array("connectivity", "", connectivity), data_array("offsets", "", offsets),
      data_array("types", "", types), data_array("psi", unit_attribute("m"), level));
}

VtuMesh::~VtuMesh() = default;

std::vector<float> VtuMesh::values(const RingField& field, int component) const {
  const PolarGrid<2>& grid = lattice_.grid();
  const int n_nodes = nodes_per_cell<2>(lattice_.degree());
  std::vector<float> result;
  result.reserve(sector_->points.size() * grid.n_sectors);
  for (int sector = 0; sector < grid.n_sectors; ++sector) {
    std::size_t point = 0;
    for (const Sector::Patch& patch : sector_->patches) {
      std::array<double, 9> nodal;
      for (int a = 0; a < n_nodes; ++a)
        nodal[a] = node_value<2>(lattice_, field, sector, patch.cell, a, component);
      for (; point < patch.end; ++point) {
        double value = 0;
        for (int a = 0; a < n_nodes; ++a) value += sector_->points[point].shape[a] * nodal[a];
        result.push_back(static_cast<float>(value));
      }
    }
  }
  return result;
}

std::string VtuMesh::data_arrays(const NamedField& f) const {
  const int n_components = f.field.components;
  if (n_components == 2) {
    const auto x = values(f.field, 0), y = values(f.field, 1);
    std::vector<float> vectors(3 * x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      vectors[3 * k] = x[k];
      vectors[3 * k + 1] = y[k];
    }
    return data_array(f.name, std::string(three_components) + unit_attribute(f.unit), vectors);
  }
  std::string arrays;
  for (int c = 0; c < n_components; ++c)
    arrays += data_array(n_components == 1 ? f.name : fmt::format("{}_{}", f.name, c), unit_attribute(f.unit),
                         values(f.field, c));
  return arrays;
}

void VtuMesh::write(const std::filesystem::path& path, std::span<const NamedField> fields) const {
  std::string content = beginning_;
  for (const NamedField& f : fields) content += data_arrays(f);
  write_atomically(path, content + "  </PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
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
