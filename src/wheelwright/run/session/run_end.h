#pragma once

#include "wheelwright/run/session/journal.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/run/session/session.h"

namespace wheelwright {

/// Ends a run with its current shape: solves what its results show, unless they are interrupted, and tells
/// the observers, which write them.
template <int dim>
RunResult<dim> end_run(const Session<dim>& session, const Journal<dim>& journal, StopReason reason,
                       const Interrupt& interrupt);

/// Ends a run whose first shape failed.
template <int dim>
RunResult<dim> end_without_shape(const Session<dim>& session, Journal<dim>& journal, const Failure& failure);

}  // namespace wheelwright
