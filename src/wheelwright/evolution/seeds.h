#pragma once

#include <vector>

#include "wheelwright/evolution/cubic_interpolant.h"

namespace wheelwright {

/// Points on {psi = 0} of one sector, about a third of the node spacing apart: one on every lattice edge
/// whose ends differ in sign, and projections of sample points from the elements that have both signs. In
/// units of the lattice's node spacing.
template <int dim>
std::vector<Vec<dim>> zero_seeds(const CubicInterpolant<dim>& psi);

}  // namespace wheelwright
