#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/report/run_summary.h"
#include "wheelwright/run/checkpoint.h"

namespace wheelwright {

/// What a run of a case made of its initial shape. `before` and `after` describe the initial shape and that
/// of the state, solved alike.
template <int dim>
RunSummary<dim> summarized_run(const Case& c, const InitialShape<dim>& initial, DescribedWheel<dim> before,
                               const OptimizationState<dim>& last, DescribedWheel<dim> after);

}  // namespace wheelwright
