#pragma once

#include "wheelwright/mechanics/rolling/adjoint.h"
#include "wheelwright/mechanics/state/topological_derivative.h"

namespace wheelwright {

/// Adds what functions owe to the growth of a rotating wheel (ContactPatch) to their shape gradients
/// (State::shape_gradients): as they say, and through the height of a rim whose travel is prescribed.
/// `adjoints` are those of the functions. Fails as the adjoint problems do.
template <int dim>
std::optional<Failure> add_growth(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                                  std::span<const FunctionalDerivative<dim>> functions,
                                  std::span<const Adjoint> adjoints, ShapeGradients& gradients);

/// The same of topological derivatives at some points.
template <int dim>
std::optional<Failure> add_growth(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                                  std::span<const FunctionalDerivative<dim>> functions,
                                  std::span<const Adjoint> adjoints,
                                  std::span<const MaterialPoint<dim>> points,
                                  std::vector<std::vector<double>>& derivatives);

}  // namespace wheelwright
