#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/optimization/nucleation/hole_places.h"
#include "wheelwright/optimization/optimizer/optimization_state.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {

/// What a search remembers of the holes that it made, until later shapes show whether they pay.
template <int dim>
struct Nucleation {
  /// The end of the search before the newest holes.
  struct Before {
    LevelSet<dim> shape;
    double objective;
    double violation;    ///< largest_violation() of its bounds
    bool is_comparable;  ///< whether its measure had reached the target
  };
  std::optional<Before> before = {};
  bool is_over = false;  ///< no more holes: none that pays was found, or the newest did not pay
};

template <int dim>
typename Nucleation<dim>::Before before_nucleation(const OptimizerOptions& options,
                                                   const OptimizationState<dim>& state);

/// Whether the shape after the newest holes is better than the one before: the objective has fallen by more
/// than what counts as noise (accepted_increase) plus no progress (tolerance), and the bounds are kept, at
/// least as well as before. True if the two cannot be compared.
template <int dim>
bool has_paid(const OptimizerOptions& options, const typename Nucleation<dim>::Before& before,
              const Evaluation<dim>& now);

/// Weights of all functions of an evaluation at the end of a search: one for the objective, the multipliers
/// of the bounds for bounded functions. If these are not known yet, a change by 1 % of a bound costs 1 % of
/// the objective.
template <int dim>
std::vector<double> lagrangian_weights(const OptimizerOptions& options, const OptimizationState<dim>& state);

/// The decrease of the objective per area, or volume, of material added at the edges of the holes: minus the
/// mean of the Lagrangian's shape gradient over the edges that are not held by a band. At an optimum of fixed
/// measure this is the measure's multiplier. Empty without such edges.
template <int dim>
std::optional<double> gain_at_edges(const OptimizerOptions& options, const Evolver<dim>& evolver,
                                    const OptimizationState<dim>& state);

/// The holes that pay most at the end of a search, by the topological derivatives of all functions at the
/// points, [function][point]; empty if none does. If the measure is fixed, that of a hole is added at the
/// edges. While the measure still has to fall and no edges can move, the best holes are made in any case.
template <int dim>
std::vector<RoundHole<dim>> paying_holes(const OptimizerOptions& options, const Evolver<dim>& evolver,
                                         const OptimizationState<dim>& state,
                                         std::span<const MaterialPoint<dim>> points,
                                         const std::vector<std::vector<double>>& derivatives,
                                         HoleRules rules);

/// One readable line.
template <int dim>
std::string nucleation_text(std::span<const RoundHole<dim>> holes);

}  // namespace wheelwright
