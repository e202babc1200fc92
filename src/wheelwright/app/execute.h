#pragma once

#include <filesystem>

#include "wheelwright/app/event_output.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/app/terminal_observer.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

// Runs that are controlled by signals. Both return an ExitCode and throw OutputError.

/// How a run is reported.
struct Reporting {
  Detail detail = Detail::progress;
  EventOutput* events = nullptr;  ///< if there is one, it replaces progress and results on the terminal
};

/// Optimizes the case and writes the folder.
int begin_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
              const Reporting& reporting = {});

/// Continues the run in a folder from its newest usable checkpoint, or from the start if it was stopped
/// before the first; `c` is the case of that folder.
int resume_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
               const Reporting& reporting = {});

}  // namespace wheelwright
