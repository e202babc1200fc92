#pragma once

#include "criteria/criterion.h"

namespace wheelwright {

/// Adjoint displacements (79) of all positions in the core, without their rim motion, in the layout of
/// RollingSolution::displacement: K p + S^T m = -dJ/dv with the transposed contact tangent. Fails with
/// no_contact when a position's contact system is singular.
template <int dim>
Expected<Matrix> solve_adjoint(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                               const AdjointLoads& loads);

}  // namespace wheelwright
