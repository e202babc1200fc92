#pragma once

#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// The summary of a run that started from `start`; `given` is given_study(). `before` and `after` describe
/// the wheel given by the case and that of the state, solved in the same way; `objective` is that of the
/// given wheel.
template <int dim>
RunSummary<dim> summarized_run(const Study<dim>& study, const Study<dim>& given,
                               const InitialShape<dim>& start, const Expected<double>& objective,
                               DescribedWheel<dim> before, const OptimizationState<dim>& last,
                               DescribedWheel<dim> after);

}  // namespace wheelwright
