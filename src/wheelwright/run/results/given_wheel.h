#pragma once

#include "wheelwright/base/interrupt.h"
#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

// A run is compared with the wheel as given by the case. The run itself starts from a shape without loose
// pieces, with the widths and the volume that the case requires: a different wheel if the given one does not
// have these.

// Their studies are given_study().

/// Whether a run starts from the given wheel unchanged. True after a stop on a coarser grid, where the wheel
/// is given again.
template <int dim>
bool begins_as_given(const Study<dim>& study, const InitialShape<dim>& start);

/// The study of the given wheel: with the radii with which the run started, if the run chose others
/// (case/design_radii.h).
template <int dim>
Study<dim> given_study(const Study<dim>& study, const InitialShape<dim>& start);

/// The objective of the given wheel, or why it cannot be computed.
template <int dim>
Expected<double> objective_as_given(const Study<dim>& study, const InitialShape<dim>& start,
                                    const Interrupt& interrupt);

/// How the wheel from which a run starts differs from the given one, in one readable line; empty if it does
/// not.
template <int dim>
std::string changed_start(const Study<dim>& study, const InitialShape<dim>& start);

}  // namespace wheelwright
