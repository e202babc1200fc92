#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// A linearized constraint on a step d: gap + bend + sign (a, d) <= 0, or = 0 for an equality.
struct LinearConstraint {
  int vector;   ///< a in the span
  double sign;  ///< 1 or -1
  double gap;   ///< violation at d = 0; negative: distance from violation
  bool is_equality;
  double bend = 0;  ///< what a step of this length adds to the linear change of the violation
  /// The cost per unit of violation in the merit function; infinite: a hard constraint. A multiplier that
  /// reaches it means that the constraint is relaxed.
  double penalty = std::numeric_limits<double>::infinity();
  /// Whether violations count in the merit function, and thus in QuadraticStep::decrease.
  bool is_in_merit = true;
};

/// The model (g, d) + (d, B d) / 2 + sum penalty * violation of a merit function, and the constraints, in the
/// span of some vectors of an inner product space, in this order: g, the vectors of constraints, then from
/// first_move on the moves and the changes of the n_pairs pairs that define B (curvature_memory.h).
struct QuadraticModel {
  Matrix products;
  std::vector<LinearConstraint> constraints;
  int first_move;
  int n_pairs;
};

/// The minimum of a model with shift |d|^2 / 2 added.
struct QuadraticStep {
  std::vector<double> coefficients;  ///< of d
  std::vector<double> multipliers;   ///< of the constraints; those of inequalities are >= 0
  double shift;
  double slope;              ///< (g, d)
  double decrease;           ///< of the model (without the shift) from d = 0; infinite penalties do not count
  std::vector<double> gaps;  ///< of the linearized constraints after the step; positive: violated
  std::vector<double> violations;  ///< the same, 0 where there is none
  bool is_feasible;                ///< false: the constraints with infinite penalties contradict each other
};

QuadraticStep quadratic_step(const QuadraticModel& model, double shift);

/// The step with the smallest shift for which length(d) <= radius, to within 3 %. If hard constraints do not
/// allow one, the shortest step.
QuadraticStep trust_region_step(const QuadraticModel& model, double radius,
                                const std::function<double(const std::vector<double>&)>& length);

}  // namespace wheelwright
