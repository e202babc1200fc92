#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"

namespace wheelwright {

/// A solution of the cyclic, linearly elastic ring as the states that the rest of the program knows.
/// `problem` must outlive it.
template <int dim>
std::shared_ptr<const State<dim>> ring_state(const RollingProblem<dim>& problem,
                                             RollingSolution<dim> solution);

}  // namespace wheelwright
