#include "wheelwright/run/pressure_files.h"

#include <fmt/format.h>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/pressure_plot.h"
#include "wheelwright/report/solution_fields.h"

namespace wheelwright {
namespace {

void write(const RunView<2>& run, const StateSolver<2>& solver, const State<2>& solution,
           const std::string& name) {
  const auto points = contact_points(solver, solution);
  std::vector<double> azimuths;
  for (const GroundPosition& ground : solver.all_positions().grounds)
    azimuths.push_back(ground.azimuth(run.study.grid()));
  write_pressure_csv<2>(run.folder / fmt::format("pressures_{}.csv", name), points);
  write_atomically(
      run.folder / fmt::format("pressures_{}.svg", name),
      plot_svg(pressure_plot(points, azimuths, fmt::format("Contact pressure, {} shape", name))));
}

}  // namespace

void PressureFiles::operator()(const Event<2>& event, const RunView<2>& run) {
  if (const auto* done = std::get_if<TrialDone<2>>(&event);
      done && done->trial.verdict == Verdict::accepted && done->state.iteration == 0 && done->trial.solution)
    write(run, *run.study.solver, *done->trial.solution, "initial");
  if (const auto* ended = std::get_if<RunEnded<2>>(&event); ended && ended->solution)
    write(run, *ended->solver, *ended->solution, "final");
}

}  // namespace wheelwright
