#pragma once

#include "wheelwright/functionals/functional.h"
#include "wheelwright/sensitivity/evaluation.h"

namespace wheelwright {

/// Objective (5) and shape gradient (42) from the solutions of one shape. `held_mean`: the mean of the
/// contact stress that uniformity criteria compare with (Evaluation::mean_observations of an earlier shape,
/// as the paper does); null for the shape's own, whose derivative is exact.
template <int dim>
Expected<Evaluation<dim>> differentiate(const RollingProblem<dim>& problem, const Criteria<dim>& criteria,
                                        const RollingSolution<dim>& solution,
                                        const Matrix* held_mean = nullptr);

/// The same for a shape: the direct problems of its distinct positions, then differentiate().
template <int dim>
Expected<Evaluation<dim>> evaluate(const RollingProblem<dim>& problem, const Criteria<dim>& criteria,
                                   const LevelSet<dim>& psi, const Matrix* held_mean = nullptr);

}  // namespace wheelwright
