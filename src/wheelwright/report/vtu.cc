#include "wheelwright/report/vtu.h"

#include <deal.II/base/data_out_base.h>
#include <fmt/format.h>

#include <map>
#include <sstream>

#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"
#include "wheelwright/files/atomic_file.h"

namespace wheelwright {
namespace {

using Patch = dealii::DataOutBase::Patch<2, 2>;
using VectorRanges =
    std::vector<std::tuple<unsigned, unsigned, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>;

/// Names of all data rows, and which rows form vectors. Row 0 is psi.
struct DataRows {
  std::vector<std::string> names{"psi"};
  VectorRanges vectors;
  std::map<std::string, std::string> units{{"psi", "m"}};

  explicit DataRows(std::span<const NamedField> fields) {
    for (const NamedField& f : fields) {
      const unsigned first = names.size();
      if (f.field.components == 2)
        vectors.emplace_back(first, first + 1, f.name,
                             dealii::DataComponentInterpretation::component_is_part_of_vector);
      for (int c = 0; c < f.field.components; ++c) {
        names.push_back(f.field.components == 1 ? f.name : fmt::format("{}_{}", f.name, c));
        units[names.back()] = f.unit;
      }
      units[f.name] = f.unit;
    }
  }
};

/// A point of a unit cell where data is written, with the shape functions of geometry and fields.
struct OutputPoint {
  ShapeFunctions<2> geometry, fields;
};

/// Turns pieces of unit cells into patches with data.
class PatchWriter {
 public:
  PatchWriter(const LevelSet<2>& psi, const Lattice<2>& lattice, std::span<const NamedField> fields,
              int n_rows)
      : psi_(psi), lattice_(lattice), fields_(fields), n_rows_(n_rows) {}

  /// The whole cell, divided by the lattice's degree.
  Patch full_cell(int sector, int cell) const {
    const int n = lattice_.degree();
    std::vector<Vec<2>> points;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) points.push_back({double(i) / n, double(j) / n});
    Patch patch = with_data(sector, cell, points);
    patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
    patch.n_subdivisions = n;
    return patch;
  }

  /// A convex polygon, as a fan of triangles.
  void append_fan(int sector, int cell, const MaterialPolygon& polygon, std::vector<Patch>& patches) const {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      Patch patch = with_data(sector, cell, {polygon[0], polygon[k - 1], polygon[k]});
      patch.reference_cell = dealii::ReferenceCells::Triangle;
      patch.n_subdivisions = 1;
      patches.push_back(std::move(patch));
    }
  }

 private:
  /// Data and positions (the last two rows) at these points of the cell.
  Patch with_data(int sector, int cell, const std::vector<Vec<2>>& points) const {
    const PolarGrid<2>& grid = lattice_.grid();
    const auto c = grid.cell_position(cell);
    const CellMap<2> map(grid, psi_.lattice.degree(), c);
    const double azimuth = sector * grid.sector_angle() + c[1] * grid.cell_size()[1];
    const std::vector<double> psi = psi_.cell_values(cell);

    Patch patch;
    patch.points_are_available = true;
    patch.data.reinit(n_rows_ + 2, points.size());
    for (std::size_t q = 0; q < points.size(); ++q) {
      const OutputPoint point{ShapeFunctions<2>(psi_.lattice.degree(), points[q]),
                              ShapeFunctions<2>(lattice_.degree(), points[q])};
      const Vec<2> x = rotated<2>(map.position(point.geometry), azimuth);
      double psi_value = 0;
      for (std::size_t a = 0; a < psi.size(); ++a) psi_value += point.geometry.value[a] * psi[a];
      int row = 0;
      patch.data(row++, q) = psi_value;
      for (const NamedField& f : fields_)
        for (int k = 0; k < f.field.components; ++k)
          patch.data(row++, q) = interpolate<2>(lattice_, f.field, sector, cell, point.fields, k);
      for (int d = 0; d < 2; ++d) patch.data(row++, q) = x[d];
    }
    return patch;
  }

  const LevelSet<2>& psi_;
  const Lattice<2>& lattice_;
  std::span<const NamedField> fields_;
  int n_rows_;
};

bool is_full(const std::vector<MaterialPolygon>& polygons) {
  return polygons.size() == 1 && polygons[0] == MaterialPolygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

std::vector<Patch> material_patches(const PatchWriter& writer, const LevelSet<2>& psi, int cut_subdivisions) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  const auto polygons = material_polygons(psi, cut_subdivisions);
  std::vector<Patch> patches;
  for (int sector = 0; sector < grid.n_sectors; ++sector) {
    for (int cell = 0; cell < grid.n_cells(); ++cell) {
      if (is_full(polygons[cell])) {
        patches.push_back(writer.full_cell(sector, cell));
        continue;
      }
      for (const MaterialPolygon& polygon : polygons[cell]) writer.append_fan(sector, cell, polygon, patches);
    }
  }
  for (std::size_t k = 0; k < patches.size(); ++k) patches[k].patch_index = k;
  return patches;
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const LevelSet<2>& psi, const Lattice<2>& lattice,
               std::span<const NamedField> fields, int cut_subdivisions) {
  const DataRows rows(fields);
  const PatchWriter writer(psi, lattice, fields, rows.names.size());
  dealii::DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.physical_units = rows.units;
  std::ostringstream content;
  content.exceptions(std::ios::badbit);  // a stream hides std::bad_alloc otherwise
  dealii::DataOutBase::write_vtu(material_patches(writer, psi, cut_subdivisions), rows.names, rows.vectors,
                                 flags, content);
  write_atomically(path, content.str());
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
