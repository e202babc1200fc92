#pragma once

#include <optional>
#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// How warm a wheel gets while it rolls, and where its heat goes. Temperatures are in degrees Celsius, powers
/// of the whole ring per metre of width when dim = 2 [W/m], else [W].
struct HeatResults {
  struct Peak {
    double temperature;           ///< the highest one at the quadrature points
    Vec<3> place;                 ///< polar coordinates of the body (m, rad, m) in sector 0; the last one is
                                  ///< 0 when dim = 2
    std::optional<double> limit;  ///< up to which the material there may be used

    bool is_too_warm() const { return limit && temperature > *limit; }
  };
  Peak peak;                   ///< of the whole ring
  std::vector<Peak> by_layer;  ///< from the rim to the tread; empty if there is one material
  double ambient;              ///< of the air

  double heat;  ///< that the losses of the material release, as the temperature's source has it
  /// Of it, what leaves through the surfaces; negative where a warmer rim heats the wheel.
  double through_rim, through_tread, through_holes, through_side_faces;
};

/// From the states of a shape; nothing unless the state's model has temperatures (has_temperatures()). Where
/// positions stand for their images, all are solved. Fails as that and the conduction do.
template <int dim>
std::optional<Expected<HeatResults>> heat_results(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                  const State<dim>& state);

}  // namespace wheelwright
