#include "wheelwright/output/report/fatigue_field.h"

#include <limits>

#include "wheelwright/mechanics/state/fatigue_utilization.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/output/report/solution_fields.h"

namespace wheelwright {
namespace {

/// Means at the nodes of a sector.
class SectorMeans {
 public:
  explicit SectorMeans(int n_nodes) : sums_(n_nodes, 0.0), counts_(n_nodes, 0) {}

  void add(int node, double value) {
    sums_[node] += value;
    ++counts_[node];
  }

  /// In every sector; NaN at nodes without a value.
  std::vector<double> repeated(int n_sectors) const {
    std::vector<double> values;
    for (int sector = 0; sector < n_sectors; ++sector)
      for (std::size_t node = 0; node < sums_.size(); ++node)
        values.push_back(counts_[node] > 0 ? sums_[node] / counts_[node]
                                           : std::numeric_limits<double>::quiet_NaN());
    return values;
  }

 private:
  std::vector<double> sums_;
  std::vector<int> counts_;
};

/// The nodes of a cell in the unit cell.
template <int dim>
std::vector<Vec<dim>> nodes_of_unit_cell(int degree) {
  std::vector<Vec<dim>> nodes;
  for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
    const auto position = local_node_position<dim>(degree, a);
    Vec<dim>& xi = nodes.emplace_back();
    for (int d = 0; d < dim; ++d) xi[d] = double(position[d]) / degree;
  }
  return nodes;
}

}  // namespace

template <int dim>
std::optional<RingField> fatigue_field(const StateSolver<dim>& solver, const State<dim>& state) {
  const RollingModel<dim>& model = solver.model();
  if (!has_fatigue_strength(model.materials) || state.positions().stand_for_images()) return {};
  const Lattice<dim> lattice = displacement_lattice(model);
  const PolarGrid<dim>& grid = model.grid;
  const std::vector<bool> is_odd_row = rows_of_odd_layers(model);
  const auto nodes = nodes_of_unit_cell<dim>(lattice.degree());
  SectorMeans means(lattice.n_nodes()), odd_means(is_odd_row.empty() ? 0 : lattice.n_nodes());
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (!state.domain().active(cell)) continue;
    const auto place = grid.cell_position(cell);
    SectorMeans& of_layer = is_odd_row.empty() || !is_odd_row[place[0]] ? means : odd_means;
    const Matrix strains = by_load_case(state.displacement().strains(cell, nodes));
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const StrainsAtPoint<dim> point{strain_columns<dim>(strains, n_strains<dim> * static_cast<int>(a)),
                                      grid.n_sectors, model.materials.in_row(grid, place[0]), place,
                                      nodes[a]};
      of_layer.add(lattice.node_index(lattice.cell_node(place, static_cast<int>(a))),
                   PointUtilization<dim>(point).value());
    }
  }
  return RingField{1, means.repeated(grid.n_sectors), is_odd_row,
                   is_odd_row.empty() ? std::vector<double>() : odd_means.repeated(grid.n_sectors)};
}

template decltype(fatigue_field<2>) fatigue_field<2>;
template decltype(fatigue_field<3>) fatigue_field<3>;

}  // namespace wheelwright
