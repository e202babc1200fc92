#pragma once

#include <filesystem>

#include "wheelwright/app/signals.h"
#include "wheelwright/app/terminal_observer.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

// A run on the terminal: with its progress, commanded by signals. Both return an ExitCode and throw
// OutputError.

/// Optimizes the case and writes the folder.
int begin_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
              Detail detail = Detail::progress);

/// Continues the run in a folder from its newest checkpoint that can be used, or from the beginning if it was
/// stopped before its first; `c` is that folder's case.
int resume_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
               Detail detail = Detail::progress);

}  // namespace wheelwright
