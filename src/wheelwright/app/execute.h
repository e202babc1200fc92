#pragma once

#include <filesystem>

#include "wheelwright/app/signals.h"
#include "wheelwright/app/terminal_observer.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

// Runs with progress on the terminal, controlled by signals. Both return an ExitCode and throw OutputError.

/// Optimizes the case and writes the folder.
int begin_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
              Detail detail = Detail::progress);

/// Continues the run in a folder from its newest usable checkpoint, or from the start if it was stopped
/// before the first; `c` is the case of that folder.
int resume_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
               Detail detail = Detail::progress);

}  // namespace wheelwright
