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

/// By active sets: moves the free unknowns to their minimum, or until one meets a bound; then frees one whose
/// multiplier has the wrong sign. Q may be singular: along its null directions the unknowns move downhill to
/// a bound.
BoxSolution solve(const BoxProgram& program);

/// The distance of x from a minimum: the largest component of x - clamp(x - gradient, lower, upper), where
/// all unknowns are scaled such that the diagonal of Q is one.
double residual(const BoxProgram& program, const std::vector<double>& x);

}  // namespace wheelwright
