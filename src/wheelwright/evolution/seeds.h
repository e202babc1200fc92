#pragma once

#include <vector>

#include "wheelwright/evolution/cubic_interpolant.h"

namespace wheelwright {

/// Points on {psi = 0} in one sector, about a third of the node spacing apart: one on each edge of the
/// lattice whose ends differ in sign, and the projections of sample points in elements whose corners differ
/// in sign. The points are in units of the node spacing of the lattice.
template <int dim>
std::vector<Vec<dim>> zero_seeds(const CubicInterpolant<dim>& psi);

}  // namespace wheelwright
