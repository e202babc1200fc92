#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/evolution/evolver.h"
#include "wheelwright/geometry/shapes.h"
#include "wheelwright/nucleation/hole_places.h"
#include "wheelwright/optimize/optimization_state.h"

namespace wheelwright {

/// What a search remembers of the holes that it made, until the next shapes tell whether they pay.
template <int dim>
struct Nucleation {
  /// The end of the search before the newest holes.
  struct Before {
    LevelSet<dim> shape;
    double objective;
    double violation;    ///< largest_violation() of its bounds
    bool is_comparable;  ///< whether its measure was the one that the search is to end with
  };
  std::optional<Before> before = {};
  bool is_over = false;  ///< no more holes are made: none was found that pays, or the newest did not
};

template <int dim>
typename Nucleation<dim>::Before before_nucleation(const OptimizerOptions& options,
                                                   const OptimizationState<dim>& state);

/// Whether a shape that the newest holes led to is better than the one before: the objective has fallen by
/// more than is accepted as noise (accepted_increase) and as no progress (tolerance), and the bounds are
/// kept, or as well as before. True where the two cannot be compared.
template <int dim>
bool has_paid(const OptimizerOptions& options, const typename Nucleation<dim>::Before& before,
              const Evaluation<dim>& now);

/// How much the objective changes per change of every function of an evaluation at the end of a search: one
/// for the objective itself, the multipliers of the bounds for bounded functions. Multipliers that are not
/// known yet count such that a change by 1 % of a bound costs 1 % of the objective.
template <int dim>
std::vector<double> lagrangian_weights(const OptimizerOptions& options, const OptimizationState<dim>& state);

/// What the objective gains per area of material that is added at the edges of the holes: minus the mean of
/// the shape gradient of the Lagrangian over the edges that no band holds. At an optimum of held measure it
/// is the measure's multiplier. Empty without such edges.
template <int dim>
std::optional<double> gain_at_edges(const OptimizerOptions& options, const Evolver<dim>& evolver,
                                    const OptimizationState<dim>& state);

/// The holes that pay most at the end of a search, by the topological derivatives of all functions at the
/// points, [function][point]; empty: none does. Where the measure is held, what a hole takes away is added at
/// the edges. While the measure still has to fall and there are no edges that could move, the best holes are
/// made in any case.
std::vector<Circle> paying_holes(const OptimizerOptions& options, const Evolver<2>& evolver,
                                 const OptimizationState<2>& state, std::span<const MaterialPoint<2>> points,
                                 const std::vector<std::vector<double>>& derivatives, HoleRules rules);

/// One line for people.
std::string nucleation_text(std::span<const Circle> holes);

}  // namespace wheelwright
