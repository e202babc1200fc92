#include "wheelwright/run/observers/pressure_files.h"

#include <fmt/format.h>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/report/pressure_plot.h"
#include "wheelwright/output/report/solution_fields.h"

namespace wheelwright {
namespace {

template <int dim>
void write(const RunView<dim>& run, const StateSolver<dim>& solver, const State<dim>& solution,
           const std::string& name) {
  const auto points = contact_points(solver, solution);
  std::vector<double> azimuths;
  for (const GroundPosition& ground : solver.all_positions().grounds)
    azimuths.push_back(ground.azimuth(run.study.grid()));
  write_pressure_csv<dim>(run.folder / fmt::format("pressures_{}.csv", name), points);
  if (dim == 3) return;  // there is no curve of the pressure along the ground
  write_atomically(
      run.folder / fmt::format("pressures_{}.svg", name),
      plot_svg(pressure_plot(points, azimuths, fmt::format("Contact pressure, {} shape", name))));
}

}  // namespace

template <int dim>
void PressureFiles<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (const auto* done = std::get_if<TrialDone<dim>>(&event);
      done && done->trial.verdict == Verdict::accepted && done->state.iteration == 0 && done->trial.solution)
    write(run, *run.study.solver, *done->trial.solution, "initial");
  if (const auto* ended = std::get_if<RunEnded<dim>>(&event); ended && ended->solution)
    write(run, *ended->solver, *ended->solution, "final");
}

template class PressureFiles<2>;
template class PressureFiles<3>;

}  // namespace wheelwright
