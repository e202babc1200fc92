#pragma once

#include <span>

#include "wheelwright/optimize/optimization_state.h"

namespace wheelwright {

/// The rejected and accepted trials since the last gain: since the last of these shapes that kept its bounds
/// and whose objective lay by more than the tolerance, relative, below that of the gain before it. The first
/// shape that keeps its bounds is one; without any, all trials count.
int trials_since_gain(std::span<const AcceptedShape> history, double tolerance);

/// Whether the objective falls by less than the tolerance over 10 shapes, relative. False if it is zero.
bool is_slow(const OptimizerOptions& options, double tolerance, std::span<const AcceptedShape> history,
             bool has_bounds);

/// Whether the search has converged at a state that keeps its bounds, after so many trials from it that were
/// rejected: with sequential quadratic steps when 6 trials have brought no gain of
/// OptimizerOptions::tolerance, with descent when it is slow.
template <int dim>
bool has_converged(const OptimizerOptions& options, const OptimizationState<dim>& state, int rejected = 0);

/// Whether the model of a move predicts a decrease of the merit function that would be a gain.
template <int dim>
bool predicts_gain(const OptimizerOptions& options, const OptimizationState<dim>& state, double decrease);

}  // namespace wheelwright
