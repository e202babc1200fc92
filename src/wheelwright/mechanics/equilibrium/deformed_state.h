#pragma once

#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"

namespace wheelwright {

/// A solution as the rest of the program sees it; `problem` must outlive it. It has no energies by harmonics
/// (they are empty) and no topological derivatives.
template <int dim>
std::shared_ptr<const State<dim>> deformed_state(const LargeDeformationProblem<dim>& problem,
                                                 LargeDeformation<dim> solution);

}  // namespace wheelwright
