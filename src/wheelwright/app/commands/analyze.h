#pragma once

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Computes the case's initial shape at its load positions, tells what an engineer asks of a wheel and, if a
/// folder is given, writes it there with plots; returns an ExitCode.
int analyze_command(const Case& c, const RunOptions& options);

}  // namespace wheelwright
