#pragma once

#include "wheelwright/rolling/adjoint.h"
#include "wheelwright/state/topological_derivative.h"

namespace wheelwright {

/// State::topological_derivatives() of a solution.
template <int dim>
Expected<std::vector<std::vector<double>>> topological_derivatives(
    const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
    std::span<const FunctionalDerivative<dim>> functions, std::span<const MaterialPoint<dim>> points);

}  // namespace wheelwright
