#include "wheelwright/app/wheel_input.h"

#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/text.h"
#include "wheelwright/case/design_radii.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/run/checkpoints/resume_point.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// The name of a folder, with or without a trailing slash.
std::string folder_name(const fs::path& folder) {
  return (fs::absolute(folder).lexically_normal() / "").parent_path().filename().string();
}

Case with_positions(Case c, const Computation& computation) {
  if (computation.positions) c.load.positions = *computation.positions;
  return c;
}

/// The case in a file or a run's folder, if the memory suffices for it.
Expected<Case, ExitCode> affordable_case(const fs::path& input, const Computation& computation) {
  const fs::path file = is_folder(input) ? input / "case.toml" : input;
  if (is_folder(input) && !is_there(file)) {
    print_err("{}: this folder contains no run: case.toml is missing\n", input.string());
    return exit_usage;
  }
  auto c = read_or_report(file);
  if (!c) return exit_usage;
  if (!may_compute(computation.command, with_positions(*c, computation), file, computation.threads))
    return exit_refused;
  return *std::move(c);
}

template <int dim>
WheelInput<dim> initial_wheel(Case c, const fs::path& file, const Computation& computation) {
  LevelSet<dim> shape = initial_shape<dim>(c);
  return {with_positions(std::move(c), computation), std::move(shape),
          without_control_characters(file.stem().string()), "initial shape"};
}

/// A run with the radii of its last shape, and if it was stopped on a coarser grid, with that grid, as its
/// case's.
template <int dim>
RunInput<dim> on_grid_of_checkpoint(RunInput<dim> run) {
  const int level = *level_of(run.source, run.checkpoint.state.shape);
  run.source = *with_radii_of(run.source, run.checkpoint.state.shape.lattice.grid(), level);
  if (level == 0) return run;
  run.source = on_coarser_grid(std::move(run.source), level);
  InitialShape<dim>& initial = run.checkpoint.initial;
  initial.shape = initial_shape<dim>(run.source);
  initial.measure = material_measure(initial.shape);
  return run;
}

template <int dim>
Expected<RunInput<dim>, ExitCode> run_in(const fs::path& folder, Case c) {
  auto point = resume_point<dim>(folder, c);
  report_unusable(point.unusable);
  if (!point.newest) {
    print_err("{}: no usable checkpoint\n", folder.string());
    return exit_checkpoint;
  }
  return on_grid_of_checkpoint<dim>({folder, std::move(c), *std::move(point.newest)});
}

/// The wheel in a file or folder with this case.
template <int dim>
Expected<WheelInput<dim>, ExitCode> wheel_of(Case c, const fs::path& input, const Computation& computation) {
  if (!is_folder(input)) return initial_wheel<dim>(std::move(c), input, computation);
  auto run = run_in<dim>(input, std::move(c));
  if (!run) return run.failure();
  OptimizationState<dim>& state = run->checkpoint.state;
  return WheelInput<dim>{with_positions(std::move(run->source), computation), std::move(state.shape),
                         without_control_characters(folder_name(input)),
                         fmt::format("shape {}", state.iteration)};
}

Expected<Case, ExitCode> plane_case(const fs::path& input, const Computation& computation) {
  auto c = affordable_case(input, computation);
  if (!c || c->wheel.dimension == 2) return c;
  print_err(
      "wheelwright {}: {}: this command overlays outlines, which a wheel in 3D does not have; `wheelwright "
      "report` shows runs in 3D side by side, with their numbers and surfaces\n",
      computation.command, input.string());
  return exit_refused;
}

}  // namespace

void add_wheel(Options& options, std::string& input) {
  options.argument("WHEEL", input, not_empty,
                   "A case file, for its initial shape, or a run's folder, for its last shape");
}

Expected<AnyWheel, ExitCode> read_wheel_or_report(const fs::path& input, const Computation& computation) {
  auto c = affordable_case(input, computation);
  if (!c) return c.failure();
  return in_dimension_of(*c, [&](auto dim) -> Expected<AnyWheel, ExitCode> {
    auto wheel = wheel_of<dim>(*std::move(c), input, computation);
    if (!wheel) return wheel.failure();
    return AnyWheel(*std::move(wheel));
  });
}

Expected<WheelInput<2>, ExitCode> read_plane_wheel_or_report(const fs::path& input,
                                                             const Computation& computation) {
  auto c = plane_case(input, computation);
  if (!c) return c.failure();
  return wheel_of<2>(*std::move(c), input, computation);
}

Expected<AnyRun, ExitCode> read_run_or_report(const fs::path& folder, const Computation& computation) {
  if (!is_folder(folder)) {
    print_err("{}: this folder contains no run: case.toml is missing\n", folder.string());
    return exit_usage;
  }
  auto c = affordable_case(folder, computation);
  if (!c) return c.failure();
  return in_dimension_of(*c, [&](auto dim) -> Expected<AnyRun, ExitCode> {
    auto run = run_in<dim>(folder, *std::move(c));
    if (!run) return run.failure();
    return AnyRun(*std::move(run));
  });
}

}  // namespace wheelwright
