#include "wheelwright/mechanics/heat/heat_source.h"

#include <algorithm>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {
namespace {

/// The power of the whole ring is force times speed; a sector has its share of it.
template <int dim>
double heat_by_force(const RollingModel<dim>& model) {
  return rolling_speed(model) / model.grid.n_sectors;
}

/// On the nodes of a cell.
struct CellLoads {
  int cell;
  std::vector<double> loads;
};

}  // namespace

template <int dim>
std::vector<double> heat_loads(const StateSolver<dim>& solver, const State<dim>& state) {
  const RollingModel<dim>& model = state.model();
  const Lattice<dim> lattice(model.grid, model.degree);
  std::vector<double> loads(lattice.n_nodes(), 0.0);
  const auto& layers = model.materials.layers();
  for (int layer = 0; layer < static_cast<int>(layers.size()); ++layer) {
    const LossFactor loss_factor = layers[layer].law->loss_factor().value_or(0);
    if (loss_factor.largest() == 0) continue;
    const LossDensity<dim> losses(model, layer, loss_factor);
    const LossOfTurn<dim> of_turn(model, loss_factor);
    const StrainedCells<dim> cells(solver, state, losses);
    const auto of_cell = [&](int k) {
      const StrainedCell<dim> cell = cells[k];
      const std::vector<double> forces = of_turn.densities(cell);
      CellLoads of_nodes{cell.cell_index, std::vector<double>(nodes_per_cell<dim>(model.degree), 0.0)};
      for (int q = 0; q < cell.n_points(); ++q) {
        const ShapeFunctions<dim> shape(model.degree, cell.points()[q]);
        for (std::size_t a = 0; a < of_nodes.loads.size(); ++a)
          of_nodes.loads[a] += heat_by_force(model) * forces[q] * cell.weights[q] * shape.value[a];
      }
      return of_nodes;
    };
    compute_in_parallel(cells.size(), of_cell, [&](int, const CellLoads& of_nodes) {
      const auto place = model.grid.cell_position(of_nodes.cell);
      for (std::size_t a = 0; a < of_nodes.loads.size(); ++a)
        loads[lattice.node_index(lattice.cell_node(place, static_cast<int>(a)))] += of_nodes.loads[a];
    });
  }
  return loads;
}

template <int dim>
WeightedHeat<dim>::WeightedHeat(const RollingModel<dim>& model, int layer,
                                std::shared_ptr<const TemperatureField<dim>> weight)
    : losses_(model, layer, model.materials.layers()[layer].law->loss_factor().value_or(0)),
      heat_by_force_(heat_by_force(model)),
      weight_(std::move(weight)) {}

template <int dim>
Matrix WeightedHeat<dim>::densities(const StrainsInCell<dim>& cell) const {
  return weighted(cell, losses_.densities(cell));
}

template <int dim>
Matrix WeightedHeat<dim>::slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const {
  return weighted(cell, losses_.slopes(cell, factors));
}

template <int dim>
Matrix WeightedHeat<dim>::weighted(const StrainsInCell<dim>& cell, Matrix values) const {
  const int columns_per_point = values.columns() / cell.n_points();
  for (int j = 0; j < values.columns(); ++j) {
    const double weight = heat_by_force_ * weight_->at(cell.cell(), cell.points()[j / columns_per_point]);
    for (int i = 0; i < values.rows(); ++i) values(i, j) *= weight;
  }
  return values;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                  \
  template decltype(heat_loads<dim>) heat_loads<dim>; \
  template class WeightedHeat<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
