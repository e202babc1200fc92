#pragma once

#include <optional>
#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// What the losses of the material cost while the wheel rolls. Forces are per metre of width when dim = 2.
struct RollingLosses {
  double resistance;   ///< the sum of by_harmonic
  double coefficient;  ///< resistance by the mean force of the wheel on the ground
  double beyond;  ///< what the harmonics that the positions do not resolve would add: resistance_beyond()
  std::vector<double> by_harmonic;  ///< of the turn, from 0 on
  std::vector<double> by_layer;     ///< from the rim to the tread; empty if there is one material
};

/// From the states of a shape; nothing unless the loss factor of every material is known. Where positions
/// stand for their images, all are solved. Fails as that does.
template <int dim>
std::optional<Expected<RollingLosses>> rolling_losses(const StateSolver<dim>& solver,
                                                      const LevelSet<dim>& psi, const State<dim>& state);

}  // namespace wheelwright
