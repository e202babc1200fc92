#pragma once

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Checks the solver on the case: Taylor test of the shape gradient; returns an ExitCode.
int verify_command(const Case& c, const RunOptions& options);

}  // namespace wheelwright
