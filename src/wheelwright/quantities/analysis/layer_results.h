#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// What a layer of the ring weighs and bears, over all load positions.
struct LayerResults {
  std::string name;
  std::optional<double> mass;  ///< of its material [kg, per metre of width when dim = 2], if it has a density
  double peak_von_mises;       ///< [Pa]
  Vec<3> peak_place;           ///< polar coordinates of the body (m, rad, m); the last one is 0 when dim = 2
  double peak_ground;          ///< azimuth of the load position with that peak, body frame [rad]
  double largest_strain;       ///< absolute value of a principal strain
};

/// The layers of the model's materials from the rim to the tread; empty if there is only one.
template <int dim>
std::vector<LayerResults> layer_results(const StateSolver<dim>& solver, const State<dim>& state);

}  // namespace wheelwright
