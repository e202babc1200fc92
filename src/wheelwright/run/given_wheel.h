#pragma once

#include "wheelwright/base/interrupt.h"
#include "wheelwright/report/run_summary.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/study.h"

namespace wheelwright {

// The wheel as the case gives it is what a run is compared with. The run itself begins with a shape that has
// no loose pieces, and the widths and the volume that the case asks for: with another wheel, where the given
// one has them not.

/// Whether a run begins with the given wheel as it is. After a stop on a coarser grid, where the wheel is
/// given anew, it does.
template <int dim>
bool begins_as_given(const Study<dim>& study, const InitialShape<dim>& start);

/// The objective of the given wheel, or why it cannot be computed.
template <int dim>
Expected<double> objective_as_given(const Study<dim>& study, const InitialShape<dim>& start,
                                    const Interrupt& interrupt);

/// How the wheel that a run begins with differs from the given one, in one line for people; empty if it
/// begins as given.
template <int dim>
std::string changed_start(const Study<dim>& study, const InitialShape<dim>& start);

}  // namespace wheelwright
