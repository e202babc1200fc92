#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "wheelwright/base/units.h"
#include "wheelwright/optimization/sensitivity/evaluation.h"

namespace wheelwright {

/// One side of the bounds of a function, at one shape. Values and violations are relative to the bound, or
/// absolute where the bound is zero.
struct BoundConstraint {
  int function;      ///< its index in Evaluation::functions
  double sign;       ///< 1: at most the bound, -1: at least
  double scale;      ///< by which values and gradients are divided
  double gap;        ///< sign (value - bound) / scale: positive if violated
  bool is_equality;  ///< both bounds are the same

  double violation() const { return is_equality ? std::abs(gap) : std::max(gap, 0.0); }
};

/// The finite bounds of all functions, in their order, lower ones first; equal bounds once.
template <int dim>
std::vector<BoundConstraint> bound_constraints(const Evaluation<dim>& evaluation);

/// The exact merit function: objective + sum penalty * violation.
double merit(double objective, const std::vector<BoundConstraint>& constraints,
             const std::vector<double>& penalties);

/// A bound with a smaller relative violation counts as kept.
inline constexpr double feasible_violation = 1e-3;

/// A bound of a function, for display and files.
struct BoundState {
  std::string name;  ///< of the function
  double value;      ///< of the function
  double bound;
  char relation;      ///< '<', '>' or '=': the required relation of value and bound
  double multiplier;  ///< by how much the objective would fall per unit by which the bound is relaxed; NaN
                      ///< before the first step
  double violation;   ///< relative to the bound
  UnitKind unit = UnitKind::energy;

  bool is_kept() const { return violation <= feasible_violation; }

  /// The relative tolerance without which the bound would not be kept; 0 if it is kept up to rounding, is not
  /// kept, or is zero.
  double kept_within() const;
};

/// All bounds of an evaluation, with the multipliers of the last step, which may be missing.
template <int dim>
std::vector<BoundState> bound_states(const Evaluation<dim>& evaluation,
                                     const std::vector<double>& multipliers);

/// The largest violation; 0 without constraints.
double largest_violation(const std::vector<BoundConstraint>& constraints);

}  // namespace wheelwright
