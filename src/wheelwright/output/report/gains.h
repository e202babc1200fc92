#pragma once

#include <string>

#include "wheelwright/output/report/run_summary.h"

namespace wheelwright {

/// The changes by a run, in one line: stiffness, run-out and the objective of the last shape against the
/// given wheel, e.g. "Compared with before: 22.4 % stiffer, run-out 51.7 % smaller, objective 18.8 % lower".
/// A change of less than 0.05 % is omitted, and an increase to more than eleven times the value is called
/// "more than ten times larger": the run-out of a wheel may have been nearly 0. Empty if none of the three
/// has a relative change.
template <int dim>
std::string gains(const RunSummary<dim>& summary);

}  // namespace wheelwright
