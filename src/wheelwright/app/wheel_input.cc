#include "wheelwright/app/wheel_input.h"

#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/text.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/run/resume_point.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// Whether or not the folder ends in a slash.
std::string folder_name(const fs::path& folder) {
  return (fs::absolute(folder).lexically_normal() / "").parent_path().filename().string();
}

Case with_positions(Case c, const Computation& computation) {
  if (computation.positions) c.load.positions = *computation.positions;
  return c;
}

/// The case of a file, if the memory suffices for it.
Expected<Case, ExitCode> affordable_case(const fs::path& file, const Computation& computation) {
  auto c = read_or_tell(file);
  if (!c) return exit_usage;
  if (!may_compute(computation.command, with_positions(*c, computation), file, computation.threads))
    return exit_refused;
  return *std::move(c);
}

Expected<WheelInput, ExitCode> initial_wheel(const fs::path& file, const Computation& computation) {
  auto c = affordable_case(file, computation);
  if (!c) return c.failure();
  LevelSet<2> shape = initial_shape<2>(*c);
  return WheelInput{with_positions(*std::move(c), computation), std::move(shape),
                    without_control_characters(file.stem().string()), "initial shape"};
}

/// A run that was stopped on a coarser grid, as if that were its case's.
RunInput on_grid_of_checkpoint(RunInput run) {
  const int level = *level_of(run.source, run.checkpoint.state.shape);
  if (level == 0) return run;
  run.source = on_coarser_grid(std::move(run.source), level);
  InitialShape<2>& initial = run.checkpoint.initial;
  initial.shape = initial_shape<2>(run.source);
  initial.measure = material_measure(initial.shape);
  return run;
}

Expected<WheelInput, ExitCode> last_wheel(const fs::path& folder, const Computation& computation) {
  auto run = read_run_or_tell(folder, computation);
  if (!run) return run.failure();
  OptimizationState<2>& state = run->checkpoint.state;
  return WheelInput{with_positions(std::move(run->source), computation), std::move(state.shape),
                    without_control_characters(folder_name(folder)),
                    fmt::format("shape {}", state.iteration)};
}

}  // namespace

void add_wheel(Options& options, std::string& input) {
  options.argument("WHEEL", input, not_empty,
                   "A case file, for its initial shape, or a run's folder, for its last shape");
}

Expected<WheelInput, ExitCode> read_wheel_or_tell(const fs::path& input, const Computation& computation) {
  return fs::is_directory(input) ? last_wheel(input, computation) : initial_wheel(input, computation);
}

Expected<RunInput, ExitCode> read_run_or_tell(const fs::path& folder, const Computation& computation) {
  const fs::path case_file = folder / "case.toml";
  if (!fs::exists(case_file)) {
    tell("{}: this folder holds no run: there is no case.toml\n", folder.string());
    return exit_usage;
  }
  auto c = affordable_case(case_file, computation);
  if (!c) return c.failure();
  auto point = resume_point<2>(folder, *c);
  report_unusable(point.unusable);
  if (!point.newest) {
    tell("{}: no checkpoint can be used\n", folder.string());
    return exit_checkpoint;
  }
  return on_grid_of_checkpoint({folder, *std::move(c), *std::move(point.newest)});
}

}  // namespace wheelwright
