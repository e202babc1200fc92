#include "wheelwright/report/field_points.h"

#include <numeric>

namespace wheelwright {

template <int dim>
void FieldPoints<dim>::add(const std::array<int, dim>& cell, const Vec<dim>& xi) {
  if (cells_.empty() || cell != last_cell_) {
    cells_.push_back(ring_cell_nodes<dim>(lattice_, cell));
    last_cell_ = cell;
  }
  points_.push_back({static_cast<int>(cells_.size()) - 1, ShapeFunctions<dim>(lattice_.degree(), xi).value});
}

template <int dim>
std::vector<std::vector<float>> FieldPoints<dim>::components(const RingField& field) const {
  const int n_sectors = lattice_.grid().n_sectors, n_nodes = nodes_per_cell<dim>(lattice_.degree());
  const std::size_t sector_nodes = lattice_.n_nodes(), ring_nodes = sector_nodes * n_sectors;
  std::vector<std::vector<float>> result(field.components);
  for (int component = 0; component < field.components; ++component) {
    result[component].reserve(points_.size() * n_sectors);
    for (int sector = 0; sector < n_sectors; ++sector) {
      int cell = -1;
      std::array<double, ShapeFunctions<dim>::max_nodes> nodal;
      for (const Point& point : points_) {
        if (point.cell != cell) {
          cell = point.cell;
          for (int a = 0; a < n_nodes; ++a) {
            const std::size_t node = (cells_[cell][a] + sector * sector_nodes) % ring_nodes;
            nodal[a] = field.values[component + field.components * node];
          }
        }
        result[component].push_back(static_cast<float>(
            std::inner_product(nodal.begin(), nodal.begin() + n_nodes, point.functions.begin(), 0.0)));
      }
    }
  }
  return result;
}

template <int dim>
std::vector<std::vector<float>> FieldPoints<dim>::values(const NamedField& field) const {
  auto all = components(field.field);
  if (!field.scalar) return all;
  std::vector<float> scalars;
  scalars.reserve(all[0].size());
  std::vector<double> at_point(all.size());
  for (std::size_t k = 0; k < all[0].size(); ++k) {
    for (std::size_t c = 0; c < all.size(); ++c) at_point[c] = all[c][k];
    scalars.push_back(static_cast<float>(field.scalar(at_point)));
  }
  return {std::move(scalars)};
}

template class FieldPoints<2>;
template class FieldPoints<3>;

}  // namespace wheelwright
