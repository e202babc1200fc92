#pragma once

#include <string>

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Loads the commands that compute, from the library beside the program, and runs the one of that name
/// ("run", "resume", "analyze" or "verify"). Returns its exit code; exit_refused, before anything is loaded
/// or written, if the case needs more memory than is available; exit_input_output if the library cannot be
/// loaded.
int load_and_run_command(const std::string& name, const Case& c, const RunOptions& options);

}  // namespace wheelwright
