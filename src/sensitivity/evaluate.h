#pragma once

#include "criteria/criterion.h"
#include "sensitivity/evaluation.h"

namespace wheelwright {

/// Objective (5) and shape gradient (42) from the solutions of one shape.
template <int dim>
Expected<Evaluation<dim>> differentiate(const RollingProblem<dim>& problem, const Criteria<dim>& criteria,
                                        const RollingSolution<dim>& solution);

/// The same for a shape: all direct problems, then differentiate().
template <int dim>
Expected<Evaluation<dim>> evaluate(const RollingProblem<dim>& problem, const Criteria<dim>& criteria,
                                   const LevelSet<dim>& psi);

}  // namespace wheelwright
