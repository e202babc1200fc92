#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/mechanics/state/functional_derivative.h"

namespace wheelwright {

/// Loads of an adjoint problem that act anywhere in the material: minus the derivative of integrals over the
/// material with respect to the displacement.
struct MaterialLoads {
  Matrix core;        ///< one row per load case, one column per unknown of the core in elimination order
  TreadForces tread;  ///< one column per (position, ring column)
};

template <int dim>
MaterialLoads material_loads(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                             std::span<const typename FunctionalDerivative<dim>::Integral> integrals);

}  // namespace wheelwright
