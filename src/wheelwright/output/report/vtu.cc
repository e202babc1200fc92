#include "wheelwright/output/report/vtu.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <stdexcept>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/report/vtu_arrays.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/surface/material_cells.h"

namespace wheelwright {
namespace {

/// The pieces of one sector's cells; the other sectors repeat them.
template <int dim>
struct SectorCells {
  struct Corner {
    std::int32_t point;
    bool in_next_sector;
  };

  std::vector<Vec<dim>> points;  ///< Cartesian, in the sector's own frame
  std::vector<float> psi;
  std::vector<Corner> corners;  ///< of all cells
  std::vector<std::int32_t> offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> layers = {};  ///< of materials, to which the cells belong; empty: there is one
};

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

template <int dim>
float value_at(const LevelSet<dim>& psi, const std::vector<double>& nodal, const Vec<dim>& xi) {
  const ShapeFunctions<dim> shape(psi.lattice.degree(), xi);
  double value = 0;
  for (std::size_t a = 0; a < nodal.size(); ++a) value += shape.value[a] * nodal[a];
  return static_cast<float>(value);
}

class PlaneCells {
 public:
  PlaneCells(const LevelSet<2>& psi, int degree, int cut_subdivisions, const std::vector<int>& layer_of_row,
             FieldPoints<2>& field_points)
      : psi_(psi), layer_of_row_(layer_of_row), field_points_(field_points) {
    const auto polygons = material_polygons(psi, cut_subdivisions);
    const std::vector<MaterialPolygon> squares = parts_of_full_cell(degree);
    for (int cell = 0; cell < psi.lattice.grid().n_cells(); ++cell)
      if (is_full(polygons[cell]))
        append_cells(cell, squares, vtk_quadrilateral);
      else
        append_cells(cell, triangles(polygons[cell]), vtk_triangle);
  }

  SectorCells<2> finished() && { return std::move(cells_); }

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

  /// Adds polygons of the unit cell, with those of their points that are new.
  void append_cells(int cell, const std::vector<MaterialPolygon>& polygons, std::uint8_t type) {
    const PolarGrid<2>& grid = psi_.lattice.grid();
    const auto c = grid.cell_position(cell);
    const CellMap<2> map(grid, psi_.lattice.degree(), c);
    const std::vector<double> nodal = psi_.cell_values(cell);
    for (const MaterialPolygon& polygon : polygons) {
      for (const Vec<2>& xi : polygon) {
        const double layer = layer_of_row_.empty() ? 0 : layer_of_row_[c[0]];
        const auto [known, is_new] = numbers_.try_emplace({c[0] + xi[0], c[1] + xi[1], layer},
                                                          static_cast<std::int32_t>(cells_.points.size()));
        if (is_new) {
          const Vec<2> x = map.position(ShapeFunctions<2>(psi_.lattice.degree(), xi));
          cells_.points.push_back(rotated<2>(x, c[1] * grid.column_angle()));
          cells_.psi.push_back(value_at<2>(psi_, nodal, xi));
          field_points_.add(c, xi);
        }
        cells_.corners.push_back({known->second, false});
      }
      cells_.offsets.push_back(static_cast<std::int32_t>(cells_.corners.size()));
      cells_.types.push_back(type);
      if (!layer_of_row_.empty()) cells_.layers.push_back(layer_of_row_[c[0]]);
    }
  }

  const LevelSet<2>& psi_;
  const std::vector<int>& layer_of_row_;
  FieldPoints<2>& field_points_;
  SectorCells<2> cells_;
  /// Of the points, by their places in units of cells and their layers.
  std::map<std::array<double, 3>, std::int32_t> numbers_;
};

SectorCells<2> sector_cells(const LevelSet<2>& psi, int degree, int cut_subdivisions,
                            const std::vector<int>& layer_of_row, FieldPoints<2>& field_points) {
  return PlaneCells(psi, degree, cut_subdivisions, layer_of_row, field_points).finished();
}

std::uint8_t vtk_number(MaterialCellKind kind) {
  switch (kind) {
    case MaterialCellKind::tetrahedron:
      return vtk_tetrahedron;
    case MaterialCellKind::wedge:
      return vtk_wedge;
    case MaterialCellKind::hexahedron:
      return vtk_hexahedron;
  }
  return 0;
}

/// Gives the cells of every layer vertices of their own where layers meet. The layers of the cells.
std::vector<std::int32_t> split_between_layers(const std::vector<int>& layer_of_row,
                                               MaterialCells& material) {
  std::vector<std::int32_t> layers;
  std::map<std::array<int, 2>, int> copies;  // by vertex and row
  const auto height = [&](int vertex) {
    return material.places[vertex].cell[0] + material.places[vertex].xi[0];
  };
  auto corner = material.corners.begin();
  for (const MaterialCellKind kind : material.kinds) {
    const auto end = corner + n_corners(kind);
    double sum = 0;
    for (auto k = corner; k != end; ++k) sum += height(k->vertex);
    const int row = static_cast<int>(sum / n_corners(kind));
    layers.push_back(layer_of_row[row]);
    for (; corner != end; ++corner) {
      if (layer_of_row[material.places[corner->vertex].cell[0]] == layer_of_row[row]) continue;
      const auto [copy, is_new] =
          copies.try_emplace({corner->vertex, row}, static_cast<int>(material.places.size()));
      if (is_new) {
        CellPoint place = material.places[corner->vertex];
        place.xi[0] += place.cell[0] - row;
        place.cell[0] = row;
        material.places.push_back(place);
        material.points.push_back(Vec<3>(material.points[corner->vertex]));
      }
      corner->vertex = copy->second;
    }
  }
  return layers;
}

SectorCells<3> sector_cells(const LevelSet<3>& psi, int degree, int cut_subdivisions,
                            const std::vector<int>& layer_of_row, FieldPoints<3>& field_points) {
  MaterialCells material = material_cells(psi, cut_subdivisions, degree);
  std::vector<std::int32_t> layers;
  if (!layer_of_row.empty()) layers = split_between_layers(layer_of_row, material);
  SectorCells<3> cells{.points = material.points, .psi = {}, .corners = {}, .offsets = {}, .types = {}};
  cells.layers = std::move(layers);
  for (const CellPoint& place : material.places) {
    field_points.add(place.cell, place.xi);
    cells.psi.push_back(
        value_at<3>(psi, psi.cell_values(psi.lattice.grid().cell_index(place.cell)), place.xi));
  }
  for (const auto& corner : material.corners) cells.corners.push_back({corner.vertex, corner.in_next_sector});
  std::int32_t end = 0;
  for (const MaterialCellKind kind : material.kinds) {
    cells.offsets.push_back(end += n_corners(kind));
    cells.types.push_back(vtk_number(kind));
  }
  return cells;
}

}  // namespace

template <int dim>
VtuMesh<dim>::VtuMesh(const LevelSet<dim>& psi, const Lattice<dim>& lattice, int cut_subdivisions,
                      std::string_view length_unit, const std::vector<int>& layer_of_row)
    : points_(lattice) {
  const SectorCells<dim> sector_of_cells =
      sector_cells(psi, lattice.degree(), cut_subdivisions, layer_of_row, points_);
  const int n_sectors = lattice.grid().n_sectors, sector_points = static_cast<int>(points_.size());
  const std::size_t n_points = points_.size() * n_sectors;
  if (n_points > std::numeric_limits<std::int32_t>::max() / 3)
    throw std::length_error("a VTU file has at most 700 million points");
  if (sector_of_cells.corners.size() * n_sectors > std::numeric_limits<std::int32_t>::max())
    throw std::length_error("the cells of a VTU file have at most 2 billion corners");
  std::vector<float> points, level;
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> layers;
  for (int sector = 0; sector < n_sectors; ++sector) {
    const int first_corner = static_cast<int>(connectivity.size());
    const std::array<int, 2> first_point{sector * sector_points, (sector + 1) % n_sectors * sector_points};
    for (const Vec<dim>& point : sector_of_cells.points) {
      const Vec<dim> x = rotated<dim>(point, sector * lattice.grid().sector_angle());
      for (int d = 0; d < 3; ++d) points.push_back(d < dim ? static_cast<float>(x[d]) : 0);
    }
    level.insert(level.end(), sector_of_cells.psi.begin(), sector_of_cells.psi.end());
    for (const auto& corner : sector_of_cells.corners)
      connectivity.push_back(first_point[corner.in_next_sector] + corner.point);
    for (const std::int32_t offset : sector_of_cells.offsets) offsets.push_back(first_corner + offset);
    types.insert(types.end(), sector_of_cells.types.begin(), sector_of_cells.types.end());
    layers.insert(layers.end(), sector_of_cells.layers.begin(), sector_of_cells.layers.end());
  }
  AppendedArrays arrays(0);
  std::string mesh = add_mesh(points, connectivity, offsets, types, arrays);
  if (!layers.empty()) mesh += "  <CellData>\n" + arrays.add("material", 1, layers) + "  </CellData>\n";
  beginning_ =
      vtu_beginning(n_points, types.size(), mesh) + arrays.add(vtu_name("psi", length_unit), 1, level);
  arrays_ = std::move(arrays).bytes();
}

template <int dim>
template <class Take>
auto VtuMesh<dim>::with_parts(std::span<const NamedField> fields, const Take& take) const {
  AppendedArrays arrays(arrays_.size());
  std::string beginning = beginning_;
  for (const NamedField& field : fields) beginning += add_field(field, points_, arrays);
  return take(vtu_parts(beginning, {arrays_, arrays.bytes()}));
}

template <int dim>
std::string VtuMesh<dim>::file(std::span<const NamedField> fields) const {
  return with_parts(fields, [](const auto& parts) {
    std::string file;
    for (const std::string_view part : parts) file += part;
    return file;
  });
}

template <int dim>
void VtuMesh<dim>::write(const std::filesystem::path& path, std::span<const NamedField> fields) const {
  with_parts(fields, [&](const auto& parts) { write_atomically(path, parts); });
}

template class VtuMesh<2>;
template class VtuMesh<3>;

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
