#pragma once

#include <array>
#include <vector>

#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The outline of the ground on which an undeformed wheel stands, as pictures draw it: [along, up], along it
/// towards larger azimuth and up from the middle of the axle [m], in the ground frame, on which the wheel
/// leans by the camber [rad]. Between two places along the ground, where there is ground, in straight lines
/// that deviate from it by at most `deviation` [m].
template <int dim>
std::vector<Vec<2>> ground_outline(const PolarGrid<dim>& grid, const Ground& ground, double camber,
                                   const std::array<double, 2>& between, double deviation);

}  // namespace wheelwright
