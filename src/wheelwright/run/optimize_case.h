#pragma once

#include <filesystem>
#include <functional>

#include "wheelwright/run/model.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/checkpoint_folder.h"

namespace wheelwright {

/// A run that was stopped, and where its checkpoints stand.
struct RunStart {
  std::filesystem::path folder;                  ///< of the run, which the caller has locked
  CheckpointFolder checkpoints;                  ///< of that folder
  std::optional<Checkpoint<2>> checkpoint = {};  ///< to go on from; without it the run begins
};

/// Optimizes the case and writes its output folder, until the run ends or is told to stop by SIGINT, SIGTERM,
/// SIGHUP or a file STOP in its folder; returns an ExitCode. Throws OutputError.
int optimize_case(const Case& c, const RunStart& start);

/// Tells what the case expected of a run that ended there, and how it turned out; returns an ExitCode.
int report_expectations(const Case& c, const Checkpoint<2>& end);

/// Does the work, which returns an ExitCode, while no other run may write to the folder; refuses when one
/// does. Throws OutputError.
int in_locked_folder(const std::filesystem::path& folder, const std::function<int()>& work);

}  // namespace wheelwright
