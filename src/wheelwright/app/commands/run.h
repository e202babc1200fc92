#pragma once

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Optimizes the case and writes its output folder; returns an ExitCode. Throws OutputError.
int run_command(const Case& c, const RunOptions& options);

}  // namespace wheelwright
