#pragma once

#include "wheelwright/functionals/functional.h"
#include "wheelwright/geometry/level_set.h"
#include "wheelwright/rolling/adjoint.h"

namespace wheelwright {

/// The density G of the shape derivative (42) on the moving boundary of one sector, summed over all positions
/// and sectors: M(u) + sigma(u):eps(p) - f.p and, under a pressure p_0
/// on the moving boundary, + p_0 div p. `adjoint` from solve_adjoint() for the weighted sum of the criteria.
template <int dim>
std::vector<SurfaceSample<dim>> shape_gradient(const RollingProblem<dim>& problem,
                                               const Criteria<dim>& criteria,
                                               const RollingSolution<dim>& solution, const Adjoint& adjoint);

}  // namespace wheelwright
