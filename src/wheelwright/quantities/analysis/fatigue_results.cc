#include "wheelwright/quantities/analysis/fatigue_results.h"

#include <algorithm>
#include <limits>

#include "wheelwright/mechanics/state/fatigue_utilization.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/quantities/analysis/all_positions.h"

namespace wheelwright {
namespace {

using Worst = FatigueResults::Worst;

template <int dim>
std::vector<Worst> worst_of_layers(const StateSolver<dim>& solver, const State<dim>& state) {
  const Materials<dim>& materials = solver.model().materials;
  const PolarGrid<dim>& grid = solver.model().grid;
  std::vector<Worst> worst(materials.layers().size(), {0, {}, {}});
  for_each_cell<dim>(solver, state, UtilizationPower<dim>(materials, 2), [&](const StrainedCell<dim>& cell) {
    Worst& of_layer = worst[materials.layer_at(grid.middle_of_row(cell.cell()[0]))];
    for (int q = 0; q < cell.n_points(); ++q) {
      const StrainsAtPoint<dim> point = cell.at(q);
      const double found = PointUtilization<dim>(point, of_layer.utilization).value();
      if (found > of_layer.utilization)
        of_layer = {
            found, {}, three_coordinates(place_in_body<dim>(grid, cell.cell_index, cell.points()[q]))};
    }
  });
  for (std::size_t k = 0; k < worst.size(); ++k)
    worst[k].life = materials.layers()[k].law->fatigue_strength()->life(worst[k].utilization);
  return worst;
}

/// The place of the largest utilization, with the shortest life of all layers, if all are known.
Worst worst_of_ring(const std::vector<Worst>& of_layers) {
  Worst worst = *std::ranges::max_element(of_layers, {}, &Worst::utilization);
  for (const Worst& of_layer : of_layers)
    worst.life =
        worst.life && of_layer.life ? std::optional(std::min(*worst.life, *of_layer.life)) : std::nullopt;
  return worst;
}

}  // namespace

template <int dim>
std::optional<Expected<FatigueResults>> fatigue_results(const StateSolver<dim>& solver,
                                                        const LevelSet<dim>& psi, const State<dim>& state) {
  if (!has_fatigue_strength(solver.model().materials)) return {};
  if (state.positions().stand_for_images()) {
    const auto all = on_all_positions(solver, psi, state);
    if (!all) return all.failure();
    return fatigue_results(solver, psi, **all);
  }
  auto of_layers = worst_of_layers(solver, state);
  FatigueResults results{worst_of_ring(of_layers), {}};
  if (of_layers.size() > 1) results.by_layer = std::move(of_layers);
  return results;
}

template decltype(fatigue_results<2>) fatigue_results<2>;
template decltype(fatigue_results<3>) fatigue_results<3>;

}  // namespace wheelwright
