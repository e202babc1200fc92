#pragma once

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Goes on with the run in options.run_folder from its newest checkpoint that can be used, or from the
/// beginning when it was killed before its first; `c` is that folder's case. Returns an ExitCode; throws
/// OutputError.
int resume_command(const Case& c, const RunOptions& options);

}  // namespace wheelwright
