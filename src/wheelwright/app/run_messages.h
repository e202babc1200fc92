#pragma once

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/run/run.h"

namespace wheelwright {

/// Tells which checkpoints cannot be used, and why.
void report_unusable(const std::vector<UnusableCheckpoint>& unusable);

/// Tells why a run did not begin or resume; returns an ExitCode.
template <int dim>
int report_not_begun(const NotBegun<dim>& reason, const std::filesystem::path& folder);

/// Tells that a signal came before the run wrote anything; returns an ExitCode.
int report_not_begun_by_signal();

/// Tells from where a run is resumed.
void report_resumption(const Resumption& resumption, const std::filesystem::path& folder);

/// Tells how a run ended; returns an ExitCode. `signals` say by what it was stopped.
template <int dim>
int report_result(const RunResult<dim>& result, const std::filesystem::path& folder, const Signals& signals);

}  // namespace wheelwright
