#pragma once

#include "wheelwright/rolling/rolling_problem.h"

namespace wheelwright {

/// The mean over the load positions of what the tread observes at a fixed place of the ground frame: p_mean
/// (73) in its traction rows. One column a ring column, counted from the one at the ground position;
/// components in the columns' own frames, which turn with the ground. The wheel's other sectors add nothing:
/// their positions see the same fields.
template <int dim>
Matrix mean_observations(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution);

/// Whether a mean, of whatever shape, is its own mirror image, up to 1e-8 of its largest entry.
template <int dim>
bool is_mirror_symmetric(const Tread<dim>& tread, const Matrix& mean);

/// What is observed less its mean, in the layout of RollingSolution::observations (body frame).
template <int dim>
Matrix deviation_from_mean(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                           const Matrix& mean);

}  // namespace wheelwright
