#include "wheelwright/output/report/field_points.h"

#include <array>
#include <cassert>

namespace wheelwright {

template <int dim>
void FieldPoints<dim>::add(const std::array<int, dim>& cell, const Vec<dim>& xi) {
  if (cells_.empty() || cell != last_cell_) {
    cells_.push_back(ring_cell_nodes<dim>(lattice_, cell));
    rows_.push_back(cell[0]);
    last_cell_ = cell;
  }
  points_.push_back({static_cast<int>(cells_.size()) - 1, ShapeFunctions<dim>(lattice_.degree(), xi).value});
}

std::vector<float> scalars(const std::vector<std::vector<float>>& components, const PointScalar& scalar) {
  std::vector<float> result;
  result.reserve(components[0].size());
  std::vector<double> at_point(components.size());
  for (std::size_t k = 0; k < components[0].size(); ++k) {
    for (std::size_t c = 0; c < components.size(); ++c) at_point[c] = components[c][k];
    result.push_back(static_cast<float>(scalar(at_point)));
  }
  return result;
}

namespace {

/// Adds the values of all components at a node with this weight.
template <int components>
void add_node(double weight, const double* at_node, std::array<double, components>& sums) {
  for (int c = 0; c < components; ++c) sums[c] += weight * at_node[c];
}

}  // namespace

template <int dim>
template <int n_components>
std::vector<std::vector<float>> FieldPoints<dim>::components(const RingField& field) const {
  const int n_sectors = lattice_.grid().n_sectors, n_nodes = nodes_per_cell<dim>(lattice_.degree());
  const std::size_t sector_nodes = lattice_.n_nodes(), ring_nodes = sector_nodes * n_sectors;
  std::vector<std::vector<float>> result(n_components, std::vector<float>(points_.size() * n_sectors));
  std::size_t k = 0;
  for (int sector = 0; sector < n_sectors; ++sector) {
    int cell = -1;
    std::array<const double*, ShapeFunctions<dim>::max_nodes> at_nodes{};
    for (const Point& point : points_) {
      if (point.cell != cell) {
        cell = point.cell;
        const std::vector<double>& values = field.in_row(rows_[cell]);
        for (int a = 0; a < n_nodes; ++a) {
          const std::size_t node = cells_[cell][a] + sector * sector_nodes;
          at_nodes[a] = &values[n_components * (node < ring_nodes ? node : node - ring_nodes)];
        }
      }
      std::array<double, n_components> sums{};
      for (int a = 0; a < n_nodes; ++a) add_node<n_components>(point.functions[a], at_nodes[a], sums);
      for (int c = 0; c < n_components; ++c) result[c][k] = static_cast<float>(sums[c]);
      ++k;
    }
  }
  return result;
}

template <int dim>
std::vector<std::vector<float>> FieldPoints<dim>::components(const RingField& field) const {
  switch (field.components) {
    case 1:
      return components<1>(field);
    case 2:
      return components<2>(field);
    case 3:
      return components<3>(field);
    case 4:
      return components<4>(field);
    default:
      assert(field.components == 6);
      return components<6>(field);
  }
}

template <int dim>
std::vector<std::vector<float>> FieldPoints<dim>::values(const NamedField& field) const {
  auto all = components(field.field);
  if (!field.scalar) return all;
  return {scalars(all, field.scalar)};
}

template class FieldPoints<2>;
template class FieldPoints<3>;

}  // namespace wheelwright
