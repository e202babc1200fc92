#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/mechanics/state/functional_derivative.h"

namespace wheelwright {

/// The adjoint problems (79) of one function at all positions.
struct Adjoint {
  /// p in the core without the rim's motion: its components along the load cases of the displacement's modes,
  /// sum_j multiplicity_j weights(j, k) p_j, as RollingSolution::displacement; in the unknowns that were
  /// asked for.
  Matrix modes;
  std::vector<RimMotion> rim;  ///< of every position
  /// The function's derivative with respect to the prescribed motion of the rim towards the ground, at every
  /// position; zero where a load is given.
  std::vector<double> by_travel;
};

/// K p + S^T m = -dJ/dv with the transposed contact tangent, for several functions as one block of right-hand
/// sides. Fails with no_contact when a position's contact system is singular. `displacement` is the
/// solution's own, or complete_displacement(): p is found in the unknowns of `sweep`, in which it must hold
/// v.
template <int dim>
Expected<std::vector<Adjoint>> solve_adjoints(const RollingProblem<dim>& problem,
                                              const RollingSolution<dim>& solution,
                                              std::span<const FunctionalDerivative<dim>> functions,
                                              const SectorFields& displacement,
                                              const PartialCholesky::Sweep& sweep);

/// In the unknowns that the shape gradient needs.
template <int dim>
Expected<std::vector<Adjoint>> solve_adjoints(const RollingProblem<dim>& problem,
                                              const RollingSolution<dim>& solution,
                                              std::span<const FunctionalDerivative<dim>> functions) {
  return solve_adjoints(problem, solution, functions, solution.displacement, solution.sweep);
}

}  // namespace wheelwright
