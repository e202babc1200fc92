#pragma once

#include <string>

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Runs the command of that name ("run", "resume", "analyze" or "verify") and returns its exit code;
/// exit_refused, before anything is written, if the case needs more memory than is available. Throws nothing.
int run_command_named(const std::string& name, const Case& c, const RunOptions& options);

}  // namespace wheelwright
