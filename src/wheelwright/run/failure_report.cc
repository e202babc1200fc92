#include "wheelwright/run/failure_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "wheelwright/case/write.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/report/svg.h"

namespace wheelwright {
namespace {

std::string headline(const GivenUp& failure) {
  const Trial<2>& trial = failure.trials.back();
  const std::string why = fmt::format("{}: {}", to_string(trial.failure->reason), trial.failure->detail);
  if (!failure.last) return "the initial shape cannot be computed with: " + why;
  return fmt::format("gave up at shape {}: none of {} trial shapes could be computed; the last: {}",
                     trial.iteration, failure.trials.size(), why);
}

std::string report(const GivenUp& failure, const PolarGrid<2>& grid) {
  std::string text = headline(failure) + "\n\n";
  if (failure.last)
    text += fmt::format("last accepted shape: {}, objective {:.8g} J/m, volume {:.6f} of the ring\n",
                        failure.last->iteration, failure.last->evaluation.objective,
                        volume_fraction(grid, failure.last->measure));
  for (const Trial<2>& trial : failure.trials)
    text += fmt::format("trial {} of shape {}: step {:.4g} cells = {:.4g} mm, volume {:.6f}: {}: {}\n",
                        trial.halvings, trial.iteration, trial.step, 1e3 * trial.step * grid.resolution(),
                        volume_fraction(grid, material_measure(trial.shape)),
                        to_string(trial.failure->reason), trial.failure->detail);
  return text +
         "\n"
         "rejected.svg        the shape that failed last\n"
         "rejected.levelset   its level set; the format is in src/output/level_set_file.h\n"
         "accepted.levelset   that of the last accepted shape, if there is one\n"
         "case.toml           the case with every key; `wheelwright check` tells what follows from it\n"
         "../history.csv      every trial of the run\n";
}

/// The shape as it can be drawn: nodes without a finite value as holes.
LevelSet<2> drawable(LevelSet<2> psi) {
  for (double& value : psi.values)
    if (!std::isfinite(value)) value = psi.lattice.grid().resolution();
  return psi;
}

WheelState wheel(const std::string& heading, const LevelSet<2>& shape, double objective, double measure) {
  return {heading, material_contours(drawable(shape), contour_subdivisions(shape.lattice.degree())),
          objective, volume_fraction(shape.lattice.grid(), measure)};
}

std::string picture(const GivenUp& failure) {
  const Trial<2>& trial = failure.trials.back();
  const PolarGrid<2>& grid = trial.shape.lattice.grid();
  const std::string reason = to_string(trial.failure->reason);
  const double objective =
      trial.evaluation ? trial.evaluation->objective : std::numeric_limits<double>::quiet_NaN();
  const WheelState rejected =
      wheel("rejected: " + reason, trial.shape, objective, material_measure(trial.shape));
  if (!failure.last) return shape_svg(grid, rejected.contours, rejected.heading);
  const OptimizationState<2>& last = *failure.last;
  const WheelState accepted = wheel(fmt::format("shape {}, accepted", last.iteration), last.shape,
                                    last.evaluation.objective, last.measure);
  return comparison_svg(
      grid, {"Where the run gave up", trial.failure->detail, "objective", "J/m", accepted, rejected});
}

}  // namespace

std::string write_failure(const std::filesystem::path& run_folder, const Case& c, const GivenUp& failure) {
  const std::filesystem::path folder = run_folder / "failure";
  make_folder(folder);
  const LevelSet<2>& rejected = failure.trials.back().shape;
  write_atomically(folder / "case.toml", to_toml(c));
  write_atomically(folder / "report.txt", report(failure, rejected.lattice.grid()));
  write_atomically(folder / "rejected.svg", picture(failure));
  write_atomically(folder / "rejected.levelset", level_set_file(rejected));
  if (failure.last) write_atomically(folder / "accepted.levelset", level_set_file(failure.last->shape));
  return fmt::format(
      "{}\n  {:<36} every failed trial, and what is in this folder\n  {:<36} the shape that failed\n",
      headline(failure), (folder / "report.txt").string(), (folder / "rejected.svg").string());
}

}  // namespace wheelwright
