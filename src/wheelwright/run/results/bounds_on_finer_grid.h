#pragma once

#include <vector>

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/quantities/functionals/shape_function.h"

namespace wheelwright {

/// Adds to the bounds of a summary whether a finer grid, whose cells are smaller by the factor `refinement`,
/// keeps them. `here` and `finer`: the bounds of the same shape on the grid of the results and on the finer
/// one, or why they are unknown. `functions`: those of the bounds.
template <int dim>
void add_finer_values(const std::vector<ShapeFunction<dim>>& functions,
                      const Expected<std::vector<BoundState>, std::string>& here,
                      const Expected<std::vector<BoundState>, std::string>& finer, double refinement,
                      std::vector<SummarizedBound>& bounds);

}  // namespace wheelwright
