#pragma once

#include <span>

#include "wheelwright/optimization/optimizer/optimization_state.h"

namespace wheelwright {

/// The number of trials, rejected ones included, since the last gain: a shape that kept its bounds and whose
/// objective was more than the relative tolerance below that of the previous gain. The first shape that keeps
/// its bounds is a gain; if none does, all trials count.
int trials_since_gain(std::span<const AcceptedShape> history, double tolerance);

/// Whether the objective falls by less than the tolerance over 10 shapes, relative. False if it is zero.
bool is_slow(const OptimizerOptions& options, double tolerance, std::span<const AcceptedShape> history,
             bool has_bounds);

/// Whether the search has converged at a state that keeps its bounds, after the given number of rejected
/// trials from it: with sequential quadratic steps if 6 trials brought no gain of
/// OptimizerOptions::tolerance, with descent if it is slow.
template <int dim>
bool has_converged(const OptimizerOptions& options, const OptimizationState<dim>& state, int rejected = 0);

/// Whether the decrease of the merit function predicted by a move's model would be a gain.
template <int dim>
bool predicts_gain(const OptimizerOptions& options, const OptimizationState<dim>& state, double decrease);

/// Whether a search with bounds that gains no more has only its small steps to blame: bounds that curve made
/// them small far from here. It is repeated with full steps and without the model of the old ones, as long as
/// that gains more than the tolerance.
template <int dim>
bool has_lost_its_model(const OptimizerOptions& options, const OptimizationState<dim>& state);

}  // namespace wheelwright
