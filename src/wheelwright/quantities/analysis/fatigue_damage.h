#pragma once

#include <optional>
#include <span>
#include <vector>

#include "wheelwright/mechanics/state/load_case.h"
#include "wheelwright/quantities/analysis/fatigue_results.h"

namespace wheelwright {

/// How long the material lasts under all load cases of a wheel together, each driven for a share of the
/// distance: damage is added at every point (mechanics/elasticity/miners_rule.h).
struct FatigueDamage {
  /// The utilization is the equivalent one.
  struct Worst : FatigueResults::Worst {
    std::vector<double> by_case;  ///< what part of the damage each load case does; 0 without any damage
  };
  Worst worst;                  ///< of the whole ring
  std::vector<Worst> by_layer;  ///< from the rim to the tread; empty if there is one material
};

/// The quadrature points of one layer under one load case.
struct UtilizedPoints {
  std::vector<Vec<3>> places;  ///< as FatigueResults::Worst::place
  std::vector<double> utilizations;
};

/// The point that lasts least among those of one layer under several load cases, if these shares of the
/// distance are driven under them. It need not be the worst one of any load case.
FatigueDamage::Worst most_damaged(const FatigueStrength& strength, std::span<const UtilizedPoints> by_case,
                                  std::span<const double> shares);

/// Whether the fatigue strength of every material and its exponent are known.
template <int dim>
bool knows_fatigue_lives(const Materials<dim>& materials);

/// The points of every layer, from the rim to the tread, under the load of the state of a shape. The fatigue
/// strengths must be known. Where positions stand for their images, all are solved. Fails as that does.
template <int dim>
Expected<std::vector<UtilizedPoints>> utilized_points(const StateSolver<dim>& solver,
                                                      const LevelSet<dim>& psi, const State<dim>& state);

/// From the utilized_points() of all load cases, [load case][layer]; fails as the first of them that has
/// failed. The lives must be known.
template <int dim>
Expected<FatigueDamage> sum_of_damages(const Materials<dim>& materials,
                                       const std::vector<Expected<std::vector<UtilizedPoints>>>& by_case,
                                       std::span<const double> shares);

/// The same from the state of a shape under the first load case; the others are solved one after the other.
/// Nothing unless their shares of the distance and the lives are known.
template <int dim>
std::optional<Expected<FatigueDamage>> fatigue_damage(const StateSolver<dim>& solver,
                                                      const LevelSet<dim>& psi, const State<dim>& first,
                                                      const LoadCases<dim>& cases,
                                                      const Interrupt& interrupt);

}  // namespace wheelwright
