#pragma once

#include <cmath>

#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// Height of the middle of the axle above height 0 of the ground on which the undeformed wheel stands [m]. If
/// it leans, by the camber [rad], it touches the ground with the edge of its tread.
template <int dim>
double axle_height(const PolarGrid<dim>& grid, const Ground& ground, double camber = 0) {
  const double on_flat = dim == 2 || camber == 0 ? grid.outer_radius
                                                 : grid.outer_radius * std::cos(camber) +
                                                       0.5 * grid.width * std::abs(std::sin(camber));
  return on_flat + ground.standing(grid.outer_radius).rise;
}

}  // namespace wheelwright
