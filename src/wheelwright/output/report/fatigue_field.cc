#include "wheelwright/output/report/fatigue_field.h"

#include <limits>

#include "wheelwright/base/units.h"
#include "wheelwright/mechanics/elasticity/miners_rule.h"
#include "wheelwright/mechanics/state/fatigue_utilization.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/quantities/analysis/fatigue_damage.h"

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

/// Values at the nodes of every cell, [cell][node of the cell]; empty in cells without material.
using ValuesOfCells = std::vector<std::vector<double>>;

template <int dim>
ValuesOfCells utilizations(const StateSolver<dim>& solver, const State<dim>& state) {
  const RollingModel<dim>& model = solver.model();
  const PolarGrid<dim>& grid = model.grid;
  const auto nodes = nodes_of_unit_cell<dim>(displacement_lattice(model).degree());
  ValuesOfCells values(grid.n_cells());
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (!state.domain().active(cell)) continue;
    const auto place = grid.cell_position(cell);
    const MaterialLaw<dim>& law = model.materials.in_row(grid, place[0]);
    const StrainsInCell<dim> strains(state.displacement().strains(cell, nodes), grid.n_sectors, law, place,
                                     nodes);
    for (int a = 0; a < strains.n_points(); ++a)
      values[cell].push_back(PointUtilization<dim>(strains.at(a)).value());
  }
  return values;
}

/// The equivalent utilizations from those under the load cases.
template <int dim>
ValuesOfCells equivalent_utilizations(const RollingModel<dim>& model,
                                      const std::vector<ValuesOfCells>& by_case,
                                      const std::vector<double>& shares) {
  ValuesOfCells values(by_case.front().size());
  for (int cell = 0; cell < model.grid.n_cells(); ++cell) {
    const auto row = model.grid.cell_position(cell)[0];
    const FatigueStrength& strength = *model.materials.in_row(model.grid, row).fatigue_strength();
    for (std::size_t a = 0; a < by_case.front()[cell].size(); ++a) {
      std::vector<double> of_node;
      for (const ValuesOfCells& of_case : by_case) of_node.push_back(of_case[cell][a]);
      values[cell].push_back(equivalent_utilization(strength, damage_per_turn(strength, of_node, shares)));
    }
  }
  return values;
}

/// The means around nodes of the values in the cells with material.
template <int dim>
RingField mean_field(const RollingModel<dim>& model, const ValuesOfCells& values) {
  const Lattice<dim> lattice = displacement_lattice(model);
  const PolarGrid<dim>& grid = model.grid;
  const std::vector<bool> is_odd_row = rows_of_odd_layers(model);
  SectorMeans means(lattice.n_nodes()), odd_means(is_odd_row.empty() ? 0 : lattice.n_nodes());
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const auto place = grid.cell_position(cell);
    SectorMeans& of_layer = is_odd_row.empty() || !is_odd_row[place[0]] ? means : odd_means;
    for (std::size_t a = 0; a < values[cell].size(); ++a)
      of_layer.add(lattice.node_index(lattice.cell_node(place, static_cast<int>(a))), values[cell][a]);
  }
  return RingField{1, means.repeated(grid.n_sectors), is_odd_row,
                   is_odd_row.empty() ? std::vector<double>() : odd_means.repeated(grid.n_sectors)};
}

}  // namespace

template <int dim>
std::optional<NamedField> fatigue_field(const StateSolver<dim>& solver, const State<dim>& state) {
  const RollingModel<dim>& model = solver.model();
  if (!has_fatigue_strength(model.materials) || state.positions().stand_for_images()) return {};
  return NamedField{"fatigue_utilization", unit<dim>(UnitKind::ratio),
                    mean_field(model, utilizations(solver, state))};
}

template <int dim>
std::optional<NamedField> fatigue_field(const StateSolver<dim>& solver, const State<dim>& first,
                                        const LoadCases<dim>& cases) {
  const RollingModel<dim>& model = solver.model();
  const auto shares = distance_shares(cases);
  if (shares.empty() || !knows_fatigue_lives(model.materials) || first.positions().stand_for_images())
    return fatigue_field(solver, first);
  std::vector<ValuesOfCells> by_case{utilizations(solver, first)};
  for (std::size_t k = 1; k < cases.size(); ++k) {
    const auto next = first.under(with_loads(first.model(), cases[k].model), Interrupt());
    if (!next) return fatigue_field(solver, first);
    by_case.push_back(utilizations(solver, **next));
  }
  return NamedField{"fatigue_of_all_loads", unit<dim>(UnitKind::ratio),
                    mean_field(model, equivalent_utilizations(model, by_case, shares))};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                            \
  template std::optional<NamedField> fatigue_field(const StateSolver<dim>&, const State<dim>&); \
  template std::optional<NamedField> fatigue_field(const StateSolver<dim>&, const State<dim>&,  \
                                                   const LoadCases<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
