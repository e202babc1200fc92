#include "wheelwright/quantities/analysis/fatigue_damage.h"

#include <algorithm>

#include "wheelwright/mechanics/elasticity/miners_rule.h"
#include "wheelwright/mechanics/state/fatigue_utilization.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/quantities/analysis/all_positions.h"

namespace wheelwright {
namespace {

std::vector<double> utilizations_of(std::span<const UtilizedPoints> by_case, std::size_t point) {
  std::vector<double> result;
  for (const UtilizedPoints& points : by_case) result.push_back(points.utilizations[point]);
  return result;
}

}  // namespace

FatigueDamage::Worst most_damaged(const FatigueStrength& strength, std::span<const UtilizedPoints> by_case,
                                  std::span<const double> shares) {
  const auto& places = by_case.front().places;
  double most = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const double damage = damage_per_turn(strength, utilizations_of(by_case, i), shares); damage > most) {
      most = damage;
      where = i;
    }
  FatigueDamage::Worst worst{{equivalent_utilization(strength, most), 1 / most, {}},
                             std::vector<double>(shares.size(), 0.0)};
  if (most == 0) return worst;
  worst.place = places[where];
  for (std::size_t k = 0; k < shares.size(); ++k)
    worst.by_case[k] = shares[k] / *strength.life(by_case[k].utilizations[where]) / most;
  return worst;
}

template <int dim>
bool knows_fatigue_lives(const Materials<dim>& materials) {
  return has_fatigue_strength(materials) && std::ranges::all_of(materials.layers(), [](const auto& layer) {
           return layer.law->fatigue_strength()->exponent.has_value();
         });
}

template <int dim>
Expected<std::vector<UtilizedPoints>> utilized_points(const StateSolver<dim>& solver,
                                                      const LevelSet<dim>& psi, const State<dim>& state) {
  if (state.positions().stand_for_images()) {
    const auto all = on_all_positions(solver, psi, state);
    if (!all) return all.failure();
    return utilized_points(solver, psi, **all);
  }
  const Materials<dim>& materials = solver.model().materials;
  const PolarGrid<dim>& grid = solver.model().grid;
  std::vector<UtilizedPoints> layers(materials.layers().size());
  for_each_cell<dim>(solver, state, UtilizationPower<dim>(materials, 2), [&](const StrainedCell<dim>& cell) {
    UtilizedPoints& layer = layers[materials.layer_at(grid.middle_of_row(cell.cell()[0]))];
    for (int q = 0; q < cell.n_points(); ++q) {
      layer.places.push_back(three_coordinates(place_in_body<dim>(grid, cell.cell_index, cell.points()[q])));
      const StrainsAtPoint<dim> point = cell.at(q);
      layer.utilizations.push_back(PointUtilization<dim>(point).value());
    }
  });
  return layers;
}

template <int dim>
Expected<FatigueDamage> sum_of_damages(const Materials<dim>& materials,
                                       const std::vector<Expected<std::vector<UtilizedPoints>>>& by_case,
                                       std::span<const double> shares) {
  for (const auto& of_case : by_case)
    if (!of_case) return of_case.failure();
  std::vector<FatigueDamage::Worst> of_layers;
  for (std::size_t k = 0; k < materials.layers().size(); ++k) {
    std::vector<UtilizedPoints> of_layer;
    for (const auto& of_case : by_case) of_layer.push_back((*of_case)[k]);
    of_layers.push_back(most_damaged(*materials.layers()[k].law->fatigue_strength(), of_layer, shares));
  }
  FatigueDamage result{
      *std::ranges::min_element(of_layers, {}, [](const FatigueDamage::Worst& w) { return *w.life; }), {}};
  if (of_layers.size() > 1) result.by_layer = std::move(of_layers);
  return result;
}

template <int dim>
std::optional<Expected<FatigueDamage>> fatigue_damage(const StateSolver<dim>& solver,
                                                      const LevelSet<dim>& psi, const State<dim>& first,
                                                      const LoadCases<dim>& cases,
                                                      const Interrupt& interrupt) {
  const Materials<dim>& materials = solver.model().materials;
  const auto shares = distance_shares(cases);
  if (shares.empty() || !knows_fatigue_lives(materials)) return {};
  std::vector<Expected<std::vector<UtilizedPoints>>> by_case{utilized_points(solver, psi, first)};
  for (std::size_t k = 1; k < cases.size(); ++k) {
    const auto next = first.under(with_loads(first.model(), cases[k].model), interrupt);
    if (!next) return next.failure();
    by_case.push_back(utilized_points(solver, psi, **next));
  }
  return sum_of_damages(materials, by_case, shares);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                    \
  template decltype(knows_fatigue_lives<dim>) knows_fatigue_lives<dim>; \
  template decltype(utilized_points<dim>) utilized_points<dim>;         \
  template decltype(sum_of_damages<dim>) sum_of_damages<dim>;           \
  template decltype(fatigue_damage<dim>) fatigue_damage<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
