#pragma once

#include "wheelwright/state/state.h"

namespace wheelwright {

/// The largest von Mises stress of every load position, over the quadrature points of the material [Pa]. The
/// tread is seen through the nodes of the level set's grid, without its refinement.
template <int dim>
std::vector<double> peak_von_mises(const StateSolver<dim>& solver, const State<dim>& state);

}  // namespace wheelwright
