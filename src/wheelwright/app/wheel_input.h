#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/options.h"
#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// A wheel that a command works on: the initial shape of a case file, or the last accepted shape of a run.
template <int dim>
struct WheelInput {
  Case source;
  LevelSet<dim> shape;
  std::string name;   ///< of the case file or of the run's folder; without control characters
  std::string which;  ///< e.g. "initial shape", "shape 31"
};

/// In the dimension of its case.
using AnyWheel = std::variant<WheelInput<2>, WheelInput<3>>;

/// A run's folder and the state to continue from.
template <int dim>
struct RunInput {
  std::filesystem::path folder;
  Case source;
  Checkpoint<dim> checkpoint;
};

/// In the dimension of its case.
using AnyRun = std::variant<RunInput<2>, RunInput<3>>;

/// WHEEL, a case file or a run's folder.
void add_wheel(Options& options, std::string& input);

/// What a command computes for a wheel.
struct Computation {
  std::string command;
  std::optional<int> threads;
  std::optional<int> positions = {};  ///< load positions per sector, instead of the case's
};

/// The wheel in a case file or a run's folder, which is not modified; the run may still be in progress. On
/// errors, including too little memory, prints a message before it allocates anything; the command ends with
/// the returned code.
Expected<AnyWheel, ExitCode> read_wheel_or_report(const std::filesystem::path& input,
                                                  const Computation& computation);

/// The run in a folder, in the same way.
Expected<AnyRun, ExitCode> read_run_or_report(const std::filesystem::path& folder,
                                              const Computation& computation);

/// For commands that support only 2D: prints a message for a case in 3D.
Expected<WheelInput<2>, ExitCode> read_plane_wheel_or_report(const std::filesystem::path& input,
                                                             const Computation& computation);

}  // namespace wheelwright
