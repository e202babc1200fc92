#pragma once

#include <string>
#include <vector>

#include "wheelwright/mechanics/rolling/rolling_problem.h"

namespace wheelwright::bench {

/// Floating-point operations of one dense or sparse kernel; an addition and a multiplication count as two.
struct KernelWork {
  std::string kernel;
  double flops;
};

/// What one shape cannot avoid with this algorithm: the kernels that a perfect implementation would run at
/// the rate of dense matrix products. Cut quadrature, assembly, Newton and all that moves data are left out.
std::vector<KernelWork> unavoidable_work(const RollingProblem<2>& problem,
                                         const RollingSolution<2>& solution);

/// Displacement unknowns of the full ring, the tread included.
template <int dim>
int ring_unknowns(const SectorSpace<dim>& space);

}  // namespace wheelwright::bench
