#pragma once

#include "wheelwright/app/signals.h"
#include "wheelwright/run/run.h"

namespace wheelwright {

/// Executes a run with its progress on the terminal; signals command it. Returns an ExitCode; throws
/// OutputError.
template <int dim>
int execute(Run<dim>& run, Signals& signals);

}  // namespace wheelwright
