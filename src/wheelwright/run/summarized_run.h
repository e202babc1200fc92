#pragma once

#include "wheelwright/report/run_summary.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/study.h"

namespace wheelwright {

/// What a run that began with `start` made of the wheel that its case gives. `before` and `after` describe
/// that wheel and the one of the state, solved alike; `objective` is that of the given wheel.
template <int dim>
RunSummary<dim> summarized_run(const Study<dim>& study, const InitialShape<dim>& start,
                               const Expected<double>& objective, DescribedWheel<dim> before,
                               const OptimizationState<dim>& last, DescribedWheel<dim> after);

}  // namespace wheelwright
