#include "wheelwright/app/wheel_input.h"

#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/text.h"
#include "wheelwright/run/resume_point.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// Whether or not the folder ends in a slash.
std::string folder_name(const fs::path& folder) {
  return (fs::absolute(folder).lexically_normal() / "").parent_path().filename().string();
}

Expected<WheelInput, ExitCode> initial_wheel(const fs::path& file) {
  auto c = read_or_tell(file);
  if (!c) return exit_usage;
  LevelSet<2> shape = initial_shape<2>(*c);
  return WheelInput{*std::move(c), std::move(shape), without_control_characters(file.stem().string()),
                    "initial shape"};
}

Expected<WheelInput, ExitCode> last_wheel(const fs::path& folder) {
  auto run = read_run_or_tell(folder);
  if (!run) return run.failure();
  OptimizationState<2>& state = run->checkpoint.state;
  return WheelInput{std::move(run->source), std::move(state.shape),
                    without_control_characters(folder_name(folder)),
                    fmt::format("shape {}", state.iteration)};
}

}  // namespace

void add_wheel(Options& options, std::string& input) {
  options.argument("WHEEL", input, not_empty,
                   "A case file, for its initial shape, or a run's folder, for its last shape");
}

Expected<WheelInput, ExitCode> read_wheel_or_tell(const fs::path& input) {
  return fs::is_directory(input) ? last_wheel(input) : initial_wheel(input);
}

Expected<RunInput, ExitCode> read_run_or_tell(const fs::path& folder) {
  const fs::path case_file = folder / "case.toml";
  if (!fs::exists(case_file)) {
    tell("{}: this folder holds no run: there is no case.toml\n", folder.string());
    return exit_usage;
  }
  auto c = read_or_tell(case_file);
  if (!c) return exit_usage;
  auto point = resume_point<2>(folder, *c);
  report_unusable(point.unusable);
  if (!point.newest) {
    tell("{}: no checkpoint can be used\n", folder.string());
    return exit_checkpoint;
  }
  return RunInput{folder, *std::move(c), *std::move(point.newest)};
}

}  // namespace wheelwright
