#include "wheelwright/app/commands/analyze.h"

#include <fmt/format.h>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/text.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/pressure_plot.h"
#include "wheelwright/report/rolling_report.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/report/wheel_pictures.h"
#include "wheelwright/run/study.h"

namespace wheelwright {
namespace {

constexpr const char* result_file = "analysis.json";

int give_up(const Failure& failure) {
  tell("wheelwright analyze: {}: {}\n", to_string(failure.reason), failure.detail);
  return exit_no_solution;
}

Expected<RollingReport> rolling_report(const Case& c, const RunOptions& options,
                                       const StateSolver<2>& solver, const State<2>& solution) {
  auto analysis = rolling_analysis(solver, solution);
  if (!analysis) return analysis.failure();
  const std::string name = without_control_characters(options.case_file.stem().string());
  RollingReport report{
      c.title.empty() ? name : c.title, c.wheel.width, c.wheel.sectors, *std::move(analysis), {}, {}};
  for (const double load : options.loads) report.loads.push_back(load / c.wheel.width);
  auto under = under_loads<2>(solver, solution, report.loads);
  if (!under) return under.failure();
  report.under_loads = *std::move(under);
  return report;
}

void write_folder(const std::filesystem::path& folder, const RollingReport& report,
                  const std::vector<ContactPoint>& points) {
  make_folder(folder);
  const auto plot = [&](const char* file, const LinePlot& picture) {
    write_atomically(folder / file, plot_svg(picture));
  };
  plot("travel.svg", travel_plot(report));
  plot("force.svg", force_plot(report));
  plot("peak_pressure.svg", peak_pressure_plot(report));
  plot("pressures.svg", pressure_plot(points, report.analysis.azimuths, "Contact pressure"));
  if (!report.loads.empty()) plot("loads.svg", load_plot(report));
  write_pressure_csv(folder / "pressures.csv", points);
  write_atomically(folder / result_file, rolling_json(report));
}

}  // namespace

int analyze_command(const Case& c, const RunOptions& options) {
  if (options.output && std::filesystem::exists(*options.output / result_file)) {
    tell("{}: holds an analysis already; choose another folder, or remove it\n", options.output->string());
    return exit_refused;
  }
  const auto made = make_solver(rolling_model<2>(c));
  if (!made) return give_up(made.failure());
  const StateSolver<2>& solver = **made;
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto solved = solver.states(shape, solver.all_positions(), Interrupt());
  if (!solved) return give_up(solved.failure());
  const State<2>& states = **solved;
  const auto report = rolling_report(c, options, solver, states);
  if (!report) return give_up(report.failure());
  fmt::print("{}", options.json
                       ? rolling_json(*report)
                       : without_control_characters(report->title) + "\n\n" + rolling_table(*report));
  if (options.output) {
    write_folder(*options.output, *report, contact_points(solver, states));
    write_wheel_pictures(*options.output, {.prefix = "", .title = report->title}, shape, states.domain(),
                         position_fields(solver, states, worst_position(states.strain_energy())));
  }
  return exit_done;
}

}  // namespace wheelwright
