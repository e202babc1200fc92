#pragma once

#include <optional>
#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// How close the material is to its fatigue limit at its worst point, and how long it lasts there.
struct FatigueResults {
  struct Worst {
    double utilization;          ///< the fatigue measure by its limit
    std::optional<double> life;  ///< in turns, if the exponent is known; infinite at utilization 0
    Vec<3> place;  ///< polar coordinates of the body (m, rad, m) in sector 0; the last one is 0 when dim = 2
  };
  Worst worst;  ///< of the whole ring: the largest utilization and, of any layer, the shortest life
  std::vector<Worst> by_layer;  ///< from the rim to the tread; empty if there is one material
};

/// From the states of a shape; nothing unless the fatigue strength of every material is known. Where
/// positions stand for their images, all are solved. Fails as that does.
template <int dim>
std::optional<Expected<FatigueResults>> fatigue_results(const StateSolver<dim>& solver,
                                                        const LevelSet<dim>& psi, const State<dim>& state);

}  // namespace wheelwright
