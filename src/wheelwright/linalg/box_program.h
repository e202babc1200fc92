#pragma once

#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// Minimize x.Q x / 2 + r.x for lower <= x <= upper, with Q symmetric and positive semidefinite. Bounds may
/// be infinite. For a few unknowns: the dual of a quadratic program with few constraints.
struct BoxProgram {
  Matrix quadratic;
  std::vector<double> linear, lower, upper;
};

struct BoxSolution {
  std::vector<double> x;
  bool is_bounded;  ///< false: the program has no minimum; x is a point on the way down
};

/// By active sets: the unknowns that are free are moved to their minimum, or until one meets a bound; then
/// one whose bound holds it back without need is set free. Q may be singular: along its null directions the
/// program goes downhill until a bound.
BoxSolution solve(const BoxProgram& program);

/// How far x is from a minimum: the largest component of x - clamp(x - gradient, lower, upper), where all
/// unknowns are scaled such that the diagonal of Q is one.
double residual(const BoxProgram& program, const std::vector<double>& x);

}  // namespace wheelwright
