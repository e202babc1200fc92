#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/options.h"
#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/study.h"

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

/// A run's folder and what it continues from.
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

/// What a command computes with a wheel.
struct Computation {
  std::string command;
  std::optional<int> threads;
  std::optional<int> positions = {};  ///< load positions per sector, instead of the case's
};

/// The wheel in a case file, or in a run's folder, of which nothing is changed; the run may still go on.
/// Tells what is wrong, and whether the memory is too small, before it allocates any; the command ends with
/// the code then.
Expected<AnyWheel, ExitCode> read_wheel_or_tell(const std::filesystem::path& input,
                                                const Computation& computation);

/// The run in a folder, in the same way.
Expected<AnyRun, ExitCode> read_run_or_tell(const std::filesystem::path& folder,
                                            const Computation& computation);

/// For commands that work in the plane of the wheel alone: they tell it of a case in 3D.
Expected<WheelInput<2>, ExitCode> read_plane_wheel_or_tell(const std::filesystem::path& input,
                                                           const Computation& computation);

}  // namespace wheelwright
