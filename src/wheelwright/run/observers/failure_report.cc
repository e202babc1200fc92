#include "wheelwright/run/observers/failure_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "wheelwright/case/layers.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/write.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/run/checkpoints/own_drawings.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/section.h"

namespace wheelwright {

template <int dim>
std::string failure_headline(const OptimizationState<dim>* last, std::span<const Trial<dim>> trials) {
  const Trial<dim>& trial = trials.back();
  const std::string why = to_string(*trial.failure);
  if (!last) return "the initial shape cannot be computed with: " + why;
  return fmt::format("gave up at shape {}: none of {} trial shapes could be computed; the last: {}",
                     trial.iteration, trials.size(), why);
}

template <int dim>
std::string volume_hint(const InitialShape<dim>& initial, const OptimizationState<dim>& last) {
  constexpr double near = 0.01;  // of the ring
  const PolarGrid<dim>& grid = last.shape.lattice.grid();
  const double from = volume_fraction(grid, initial.measure), to = volume_fraction(grid, last.target_measure);
  if (std::abs(to - from) < near) return "";
  return fmt::format(
      "volume.target = {:.6g} may be the reason: the volume was {:.6g} of the ring at first and {:.6g} at "
      "last; a target closer to the first may succeed, or a smaller volume.rate",
      to, from, volume_fraction(grid, last.measure));
}

template decltype(volume_hint<2>) volume_hint<2>;
template decltype(volume_hint<3>) volume_hint<3>;

template decltype(failure_headline<2>) failure_headline<2>;
template decltype(failure_headline<3>) failure_headline<3>;

namespace {

template <int dim>
std::string report(const RunEnded<dim>& failure, const RunView<dim>& run) {
  const PolarGrid<dim>& grid = run.study.grid();
  std::string text = failure_headline<dim>(failure.state, failure.failed_trials) + "\n\n";
  if (failure.state)
    if (const std::string hint = volume_hint(*run.initial, *failure.state); !hint.empty())
      text += hint + "\n\n";
  const ShownUnit shown = shown_unit(run.study.source.objective.minimize, run.study.source.wheel);
  if (failure.state)
    text += fmt::format("last accepted shape: {}, objective {:.8g} {}, volume {:.6f} of the ring\n",
                        failure.state->iteration,
                        failure.state->evaluation.function("objective").value * shown.factor, shown.name,
                        volume_fraction(grid, failure.state->measure));
  for (const Trial<dim>& trial : failure.failed_trials)
    text += fmt::format("trial {} of shape {}: step {:.4g} cells = {:.4g} mm, volume {:.6f}: {}\n",
                        trial.halvings, trial.iteration, trial.step, 1e3 * trial.step * grid.resolution(),
                        volume_fraction(grid, material_measure(trial.shape)), to_string(*trial.failure));
  return text +
         "\n"
         "rejected.svg        the shape that failed last; in 3D its mid-plane\n"
         "rejected.levelset   its level set; the format is in src/wheelwright/files/level_set_file.h\n"
         "accepted.levelset   that of the last accepted shape, if there is one\n"
         "case.toml           the case with every key; `wheelwright check` prints the derived values\n"
         "../history.csv      every trial of the run\n";
}

/// A drawable version of the shape: its mid-plane section, with nodes that are not finite as holes.
template <int dim>
LevelSet<2> drawable(const LevelSet<dim>& shape) {
  LevelSet<2> psi = mid_plane_section(shape);
  for (double& value : psi.values)
    if (!std::isfinite(value)) value = psi.lattice.grid().resolution();
  return psi;
}

template <int dim>
WheelState<2> wheel(const std::string& heading, const LevelSet<dim>& shape, double objective,
                    double measure) {
  return {heading, material_contours(drawable(shape), contour_subdivisions(shape.lattice.degree())),
          objective, volume_fraction(shape.lattice.grid(), measure)};
}

template <int dim>
std::string picture(const RunEnded<dim>& failure, const Case& c) {
  const Quantity minimized = minimized_quantity(c);
  const ShownUnit shown = shown_unit(minimized, c.wheel);
  const Trial<dim>& trial = failure.failed_trials.back();
  const PolarGrid<2> grid = mid_plane_section(trial.shape).lattice.grid();
  const std::string reason = to_string(trial.failure->reason);
  const double objective = trial.evaluation ? trial.evaluation->function("objective").value * shown.factor
                                            : std::numeric_limits<double>::quiet_NaN();
  const WheelState<2> rejected =
      wheel("rejected: " + reason, trial.shape, objective, material_measure(trial.shape));
  if (!failure.state) return shape_svg(grid, rejected.boundary, rejected.heading);
  const OptimizationState<dim>& last = *failure.state;
  const WheelState<2> accepted =
      wheel(fmt::format("shape {}, accepted", last.iteration), last.shape,
            last.evaluation.function("objective").value * shown.factor, last.measure);
  return comparison_svg(grid, {.title = "Where the run gave up",
                               .caption = trial.failure->detail,
                               .objective_name = name(minimized),
                               .objective_unit = shown.name,
                               .before = accepted,
                               .after = rejected});
}

}  // namespace

template <int dim>
void FailureReport<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto* ended = std::get_if<RunEnded<dim>>(&event);
  if (!ended || ended->failed_trials.empty() ||
      (ended->reason != StopReason::gave_up && ended->reason != StopReason::failed_start))
    return;
  make_subfolder(run.folder / "failure");
  const LevelSet<dim>& rejected = ended->failed_trials.back().shape;
  write_drawings(run.folder / "failure", run.study.source);
  write_atomically(run.folder / "failure/case.toml", to_toml(run.study.source));
  write_atomically(run.folder / failure_report_file, report(*ended, run));
  write_atomically(run.folder / rejected_picture_file, picture(*ended, run.study.source));
  write_atomically(run.folder / "failure/rejected.levelset", level_set_file(rejected));
  if (ended->state)
    write_atomically(run.folder / "failure/accepted.levelset", level_set_file(ended->state->shape));
}

template class FailureReport<2>;
template class FailureReport<3>;

}  // namespace wheelwright
