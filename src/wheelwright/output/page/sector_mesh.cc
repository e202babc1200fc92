#include "wheelwright/output/page/sector_mesh.h"

#include <array>
#include <cmath>
#include <map>
#include <span>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

/// Collects the points of a sector's polygons; shared points are merged.
class SectorMeshBuilder {
 public:
  SectorMeshBuilder(const LevelSet<2>& psi, const Lattice<2>& field_lattice,
                    const std::vector<bool>& is_odd_row)
      : psi_(psi), field_lattice_(field_lattice), is_odd_row_(is_odd_row) {}

  std::uint32_t add(int cell, const Vec<2>& xi) {
    const Vec<2> x = position(cell, xi);
    const auto place = grid().cell_position(cell);
    const auto [entry, is_new] =
        known_.try_emplace(key(x, place[0]), static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) {
      mesh_.points.push_back(x);
      mesh_.rows.push_back(place[0]);
      mesh_.nodes.push_back(ring_cell_nodes<2>(field_lattice_, place));
      mesh_.shapes.emplace_back(field_lattice_.degree(), xi);
    }
    return entry->second;
  }

  /// Whether there is a point here, or in an adjacent sector that shares the edge.
  bool has(int cell, const Vec<2>& xi) const {
    const Vec<2> x = position(cell, xi);
    const int row = grid().cell_position(cell)[0];
    for (const int sector : {0, 1, -1})
      if (known_.contains(key(rotated<2>(x, sector * grid().sector_angle()), row))) return true;
    return false;
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }

  void add_layer_edge(std::uint32_t a, std::uint32_t b) {
    mesh_.layer_edges.insert(mesh_.layer_edges.end(), {a, b});
  }

  SectorMesh mesh() && { return std::move(mesh_); }

 private:
  const PolarGrid<2>& grid() const { return psi_.lattice.grid(); }
  Vec<2> position(int cell, const Vec<2>& xi) const {
    const auto place = grid().cell_position(cell);
    const CellMap<2> map(grid(), psi_.lattice.degree(), place);
    return rotated<2>(map.position(ShapeFunctions<2>(psi_.lattice.degree(), xi)),
                      place[1] * grid().column_angle());
  }
  /// Points of different layers are not merged: fields jump between them.
  std::array<long, 3> key(const Vec<2>& x, int row) const {
    constexpr double resolution = 1e7;  // [1/m]
    return {std::lround(x[0] * resolution), std::lround(x[1] * resolution),
            !is_odd_row_.empty() && is_odd_row_[row]};
  }

  const LevelSet<2>& psi_;
  const Lattice<2>& field_lattice_;
  const std::vector<bool>& is_odd_row_;
  std::map<std::array<long, 3>, std::uint32_t> known_;
  SectorMesh mesh_;
};

/// Visits a field's components at the points of a mesh in all sectors, in the order point + n_points *
/// sector.
template <std::size_t n_components, class Visit>
void for_each_point(const SectorMesh& mesh, const Lattice<2>& lattice, const RingField& field,
                    const Visit& visit) {
  const int n_nodes = nodes_per_cell<2>(lattice.degree()), n_sectors = lattice.grid().n_sectors;
  const std::size_t sector_nodes = lattice.n_nodes(), ring_nodes = sector_nodes * n_sectors;
  for (int sector = 0; sector < n_sectors; ++sector)
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
      RingCellNodes<2> nodes = mesh.nodes[k];
      for (int a = 0; a < n_nodes; ++a) {
        nodes[a] += sector * sector_nodes;
        if (nodes[a] >= ring_nodes) nodes[a] -= ring_nodes;
      }
      visit(interpolate<n_components>(field, nodes, std::span(mesh.shapes[k].value.data(), n_nodes),
                                      mesh.rows[k]));
    }
}

}  // namespace

SectorMesh sector_mesh(const LevelSet<2>& psi, const RollingModel<2>& model) {
  constexpr int cut_subdivisions = 2;
  const auto polygons = material_polygons(psi, cut_subdivisions);
  const Lattice<2> field_lattice = displacement_lattice(model);
  const std::vector<bool> is_odd_row = rows_of_odd_layers(model);
  SectorMeshBuilder builder(psi, field_lattice, is_odd_row);
  const auto ends_layer = [&](int cell) {
    const int row = model.grid.cell_position(cell)[0];
    return row + 1 < model.grid.cells[0] && model.materials.is_interface(model.grid, row);
  };
  const int n_cells = psi.lattice.grid().n_cells();
  for (int cell = 0; cell < n_cells; ++cell)
    for (const MaterialPolygon& polygon : polygons[cell])
      for (const Vec<2>& xi : polygon) builder.add(cell, xi);
  for (int cell = 0; cell < n_cells; ++cell)
    for (const MaterialPolygon& polygon : polygons[cell]) {
      std::vector<std::uint32_t> corners;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec<2>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const Vec<2> middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
        corners.push_back(builder.add(cell, a));
        if (builder.has(cell, middle)) corners.push_back(builder.add(cell, middle));
        if (ends_layer(cell) && a[0] == 1 && b[0] == 1) {
          if (corners.back() != builder.add(cell, a))
            builder.add_layer_edge(builder.add(cell, a), corners.back());
          builder.add_layer_edge(corners.back(), builder.add(cell, b));
        }
      }
      for (std::size_t k = 2; k < corners.size(); ++k)
        builder.add_triangle(corners[0], corners[k - 1], corners[k]);
    }
  return std::move(builder).mesh();
}

MeshPosition on_mesh(const SectorMesh& mesh, const PositionFields<2>& fields) {
  MeshPosition position{.ground_azimuth = fields.ground_azimuth,
                        .x = {},
                        .y = {},
                        .von_mises = {},
                        .ground = shown_ground(fields)};
  const std::size_t n_points = mesh.points.size() * fields.lattice.grid().n_sectors;
  for (auto* values : {&position.x, &position.y, &position.von_mises}) values->reserve(n_points);
  for_each_point<2>(mesh, fields.lattice, fields.displacement, [&](const auto& u) {
    position.x.push_back(u[0]);
    position.y.push_back(u[1]);
  });
  for_each_point<stress_components<2>>(mesh, fields.lattice, fields.stress, [&](const auto& stress) {
    position.von_mises.push_back(std::min(von_mises_of(stress), fields.von_mises.value));
  });
  return position;
}

}  // namespace wheelwright
