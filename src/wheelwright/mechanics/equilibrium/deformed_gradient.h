#pragma once

#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"

namespace wheelwright {

/// The adjoint problem of one function at one load position.
template <int dim>
struct DeformedAdjoint {
  std::vector<double> p;  ///< without the rim's motion, on the dofs of RingSpace
  RimMotion rim;
  double by_travel = 0;  ///< the function's derivative with respect to a prescribed travel
};

/// The adjoint problems of several functions, [function][position]: K p + S^T m = -dJ/dv with the tangent K
/// of ring and ghost penalty at the solution and the transposed tangent of the contact. `displacement`: that
/// of the solution.
template <int dim>
Expected<std::vector<std::vector<DeformedAdjoint<dim>>>> solve_adjoints(
    const LargeDeformationProblem<dim>& problem, const LargeDeformation<dim>& solution,
    const Displacement<dim>& displacement, std::span<const FunctionalDerivative<dim>> functions);

/// The densities of the shape derivatives of several functions at moving_boundary_points(), summed over all
/// positions (as often as they count) and sectors: energy W + M + P : grad p. Where ln J is projected it is
/// the derivative of the discrete energy, W_kept + L (q ln J - q^2/2) with the projected part L of lambda and
/// the projection q of ln J.
template <int dim>
ShapeGradients shape_gradients(const LargeDeformation<dim>& solution, const Displacement<dim>& displacement,
                               std::span<const FunctionalDerivative<dim>> functions,
                               std::span<const std::vector<DeformedAdjoint<dim>>> adjoints);

}  // namespace wheelwright
