#pragma once

#include <cstdio>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/run/session/run.h"

namespace wheelwright {

/// Prints which checkpoints are unusable, and why.
void report_unusable(const std::vector<UnusableCheckpoint>& unusable);

/// Prints why a run did not start or resume, and on `stream` the results of one that is finished; returns an
/// ExitCode.
template <int dim>
int report_not_begun(const NotBegun<dim>& reason, const std::filesystem::path& folder,
                     std::FILE* stream = stdout);

/// Prints that a signal arrived before the run wrote anything; returns an ExitCode.
int report_not_begun_by_signal();

/// Prints where a run is resumed.
void report_resumption(const Resumption& resumption, const std::filesystem::path& folder);

/// The ExitCode of a run that ended. `signals` tell which signal stopped it.
template <int dim>
int exit_code_of(const RunResult<dim>& result, const Signals& signals);

/// Prints how a run ended; returns an ExitCode. `signals` tell which signal stopped it.
template <int dim>
int report_result(const RunResult<dim>& result, const std::filesystem::path& folder, const Signals& signals);

}  // namespace wheelwright
