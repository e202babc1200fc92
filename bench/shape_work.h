#pragma once

#include <string>
#include <vector>

#include "wheelwright/mechanics/rolling/rolling_problem.h"

namespace wheelwright::bench {

/// The phases to which kernels belong.
inline constexpr const char *of_factors = "sector's factor, harmonics",
                            *of_contact_operator = "contact operator",
                            *of_positions = "positions, displacements", *of_gradient = "adjoints, gradient";

/// The dense kernels of one part of a shape. An addition and a multiplication count as two operations,
/// complex ones as four times as many.
struct PartWork {
  std::string phase;  ///< to whose time it belongs
  std::string part;
  double flops;
  /// Operations that follow each other on one thread, however many threads there are: the part cannot take
  /// less time.
  double longest_chain;
};

/// The work of one shape in 3D with this solver, by its sizes and as its loops are shared among threads now;
/// of the adjoints those of one function. Cut quadrature, assembly, elimination order, and all that only
/// moves data have none.
std::vector<PartWork> shape_work(const RollingProblem<3>& problem, const RollingSolution<3>& solution);

/// The smallest sum over the parts of the longer of its chain and its share of `cores` [flops].
double flops_in_turn(const std::vector<PartWork>& parts, double cores);

}  // namespace wheelwright::bench
