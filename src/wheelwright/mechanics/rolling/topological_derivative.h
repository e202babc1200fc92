#pragma once

#include "wheelwright/mechanics/rolling/adjoint.h"
#include "wheelwright/mechanics/state/topological_derivative.h"

namespace wheelwright {

/// State::topological_derivatives() of a solution.
template <int dim>
Expected<std::vector<std::vector<double>>> topological_derivatives(
    const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
    std::span<const FunctionalDerivative<dim>> functions, std::span<const MaterialPoint<dim>> points);

}  // namespace wheelwright
