#pragma once

#include "wheelwright/functionals/functional.h"

namespace wheelwright {

/// The adjoint problems (79) of all positions.
struct Adjoint {
  /// p in the core without the rim's motion: its components along the load cases of the displacement's modes,
  /// sum_j multiplicity_j weights(j, k) p_j, as RollingSolution::displacement.
  Matrix modes;
  std::vector<RimMotion> rim;  ///< of every position
};

/// K p + S^T m = -dJ/dv with the transposed contact tangent. Fails with no_contact when a position's contact
/// system is singular.
template <int dim>
Expected<Adjoint> solve_adjoint(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                                const AdjointLoads& loads);

}  // namespace wheelwright
