#include "wheelwright/run/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/geometry/section.h"
#include "wheelwright/report/shape_boundary.h"
#include "wheelwright/report/surface_vtp.h"
#include "wheelwright/report/wheel_pictures.h"
#include "wheelwright/run/case_report.h"
#include "wheelwright/run/failure_report.h"
#include "wheelwright/run/feature_warnings.h"
#include "wheelwright/run/history.h"
#include "wheelwright/run/provenance.h"
#include "wheelwright/run/roughness_warning.h"
#include "wheelwright/run/run_title.h"
#include "wheelwright/run/stop_text.h"
#include "wheelwright/run/study.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

double number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Rows that come one after the other, evenly thinned to at most twice `most`, with the first and the last
/// one.
class ThinnedRows {
 public:
  static constexpr std::size_t most = 1000;

  void add(std::vector<double> row) {
    last_ = std::move(row);
    if (n_++ % step_ != 0) return;
    rows_.push_back(last_);
    if (rows_.size() < 2 * most) return;
    for (std::size_t k = 1; 2 * k < rows_.size(); ++k) rows_[k] = std::move(rows_[2 * k]);
    rows_.resize(rows_.size() / 2);
    step_ *= 2;
  }

  std::vector<std::vector<double>> rows() const {
    auto result = rows_;
    if (n_ > 0 && (n_ - 1) % step_ != 0) result.push_back(last_);
    return result;
  }

 private:
  std::size_t n_ = 0, step_ = 1;
  std::vector<std::vector<double>> rows_;
  std::vector<double> last_;
};

/// The newest of what happened to the holes.
class NewestEvents {
 public:
  static constexpr std::size_t most = 400;

  void add(HoleEvents event) {
    newest_.push_back(std::move(event));
    if (newest_.size() <= most) return;
    newest_.pop_front();
    ++left_out_;
  }

  std::vector<HoleEvents> newest() const { return {newest_.begin(), newest_.end()}; }
  int left_out() const { return left_out_; }

 private:
  std::deque<HoleEvents> newest_;
  int left_out_ = 0;
};

/// The columns of the accepted shapes that hold numbers, thinned where there are thousands of them, how many
/// trials there were, why some were rejected, and what happened to the holes lately.
template <int dim>
void read_history(const fs::path& file, ReportRun<dim>& run) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return;
  for (const std::string& name : csv_cells(line))
    if (name != "reason" && name != "events") run.history.push_back({name, {}});
  const auto columns = csv_cells(line);
  const auto index = [&](const char* name) { return std::ranges::find(columns, name) - columns.begin(); };
  const auto accepted = index("accepted"), reason = index("reason"), events = index("events"),
             iteration = index("iteration");
  ThinnedRows accepted_rows;
  NewestEvents newest_events;
  while (std::getline(stream, line)) {
    const auto cells = csv_cells(line);
    if (cells.size() != columns.size()) continue;
    const auto cell = [&](std::ptrdiff_t k) { return k < std::ssize(cells) ? cells[k] : std::string(); };
    ++run.trials;
    if (cell(accepted) != "1") {
      ++run.rejected[cell(reason)];
      continue;
    }
    if (!cell(events).empty()) newest_events.add({cell(iteration), cell(events)});
    std::vector<double> row;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k] != "reason" && columns[k] != "events") row.push_back(number(cells[k]));
    accepted_rows.add(std::move(row));
  }
  run.events = newest_events.newest();
  run.events_left_out = newest_events.left_out();
  for (const auto& row : accepted_rows.rows())
    for (std::size_t k = 0; k < row.size(); ++k) run.history[k].values.push_back(row[k]);
}

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

template <int dim>
double last_elapsed(const ReportRun<dim>& run) {
  for (const HistoryCurve& curve : run.history)
    if (curve.name.starts_with("elapsed") && !curve.values.empty()) return curve.values.back();
  return 0;
}

std::string status_text(std::optional<StopReason> reason) { return reason ? text(*reason) : "not ended"; }

template <int dim>
std::vector<std::string> flags(const Case& c, const RunSummary<dim>& summary,
                               std::optional<StopReason> reason) {
  const DescribedWheel<dim>& wheel = summary.after.wheel;
  std::vector<std::string> result;
  for (const SummarizedBound& bound : summary.bounds)
    if (!bound.is_kept)
      result.push_back(fmt::format("The bound {} {} {:.6g} {} is not kept: the value is {:.6g} {}.",
                                   bound.name, bound.relation, bound.bound * bound.shown.factor,
                                   bound.shown.name, bound.value * bound.shown.factor, bound.shown.name));
  if (wheel.loaded)
    if (const auto warning = deformation_warning(wheel.loaded->summary.deformation); !warning.empty())
      result.push_back(warning);
  if (wheel.outline)
    for (const std::string& warning : feature_warnings(c, wheel.outline->clearances))
      result.push_back(warning);
  if (const auto warning = roughness_warning(c, roughness(wheel), roughness(summary.before.wheel));
      !warning.empty())
    result.push_back(warning);
  for (const std::string& warning : warnings(with_levels_of_results(c))) result.push_back(warning);
  for (const std::string& line : missing_lines(summary)) result.push_back(line);
  for (const Remark& remark : summary.remarks) result.push_back(text(remark));
  if (!summary.changed_start.empty()) result.push_back(summary.changed_start);
  if (reason == StopReason::iterations && convergence_tolerance(c) > 0)
    result.push_back(
        "The run ended by its number of shapes before it converged: more shapes may improve the wheel.");
  if (reason == StopReason::gave_up)
    result.push_back(
        "The run gave up: the file failure/report.txt says why. The shape is the last one that was "
        "accepted.");
  if (!reason || reason == StopReason::stop_requested)
    result.push_back("The run has not ended by itself: more shapes may improve the wheel.");
  return result;
}

/// What the numbers do not tell.
template <int dim>
std::vector<std::string> limits(const Case& c, const DescribedWheel<dim>& wheel) {
  const Case shown = with_levels_of_results(c);
  std::vector<std::string> result{
      "The material is linear elastic: no creep, no heat, no fatigue. Whether it bears the peak stress is "
      "not "
      "judged."};
  result.push_back(
      fmt::format("Rolling is a row of {} load positions per sector, each at rest: no inertia, no "
                  "rolling resistance.",
                  c.load.positions));
  if (dim == 2)
    result.push_back(
        fmt::format("The wheel and its load are the same over the whole width ({}): forces along the "
                    "axle and the ends of the width are left out.",
                    c.material.plane == Plane::stress ? "plane stress" : "plane strain"));
  std::string cells =
      fmt::format("It was computed on {} x {} cells", c.grid.radial_cells, c.grid.angular_cells);
  if (!c.load.travel)
    cells += fmt::format("; the contact patch is {:.1f} cells wide", cells_per_contact_patch(shown));
  if (wheel.outline && wheel.outline->clearances.wall)
    cells += fmt::format("; the thinnest wall is {:.1f} cells thick",
                         wheel.outline->clearances.wall->width / polar_grid<2>(c).resolution());
  result.push_back(cells + ". A finer grid shows how much that matters.");
  return result;
}

/// Calls show(name, state) for each load case after the first one that is solved.
template <int dim>
void for_other_loads(const Case& c, const State<dim>& first, const auto& show) {
  const LoadCases<dim> cases = load_cases<dim>(c);
  for (std::size_t k = 1; k < cases.size(); ++k)
    if (const auto state = first.under(with_loads_of(first.model(), cases[k].model), Interrupt()))
      show(cases[k].name, **state);
}

void add_fields(const Case& c, const SolvedShape<2>& last, ReportRun<2>& run) {
  run.positions = all_position_fields(*last.solver, *last.solution);
  for_other_loads<2>(c, *last.solution, [&](const std::string& name, const State<2>& state) {
    run.other_loads.push_back({name, all_position_fields(*last.solver, state)});
  });
}

/// The page holds no more fields of one load of a wheel in 3D.
constexpr double most_page_bytes = 8e6;

/// Bytes that the fields of so many positions take in the page.
double page_bytes(const SurfaceMesh& surface, int positions) {
  constexpr double bytes_per_vertex = (3 * 2 + 1) * 4.0 / 3;
  return bytes_per_vertex * static_cast<double>(surface.points.size()) * positions;
}

struct LitWheel {
  SurfaceMesh surface;
  std::vector<SurfacePosition> positions;
};

/// The surface, as fine as the page holds it with so many positions, but at least with one cube per cell.
SurfaceMesh page_surface(const SolvedShape<3>& last, int positions) {
  const int degree = last.solver->model().degree;
  SurfaceMesh surface = shape_boundary(*last.shape, degree);
  return page_bytes(surface, positions) > most_page_bytes ? material_surface(*last.shape, 1, degree)
                                                          : surface;
}

template <class Points>
SurfacePosition on_points(const PositionFields<3>& fields, const Points& points) {
  return {fields.ground_azimuth, points.values({"displacement", "m", fields.displacement}),
          points.values(von_mises_field(fields.stress))[0]};
}

/// The fields of all positions at the vertices of a surface; where they are too many for the page, those of
/// the worst position.
std::vector<SurfacePosition> lit_positions(const SurfaceMesh& surface, const StateSolver<3>& solver,
                                           const State<3>& solution) {
  const bool all = page_bytes(surface, solver.model().n_positions) <= most_page_bytes;
  const int worst = worst_position(solution.strain_energy());
  const auto points = field_points(surface, displacement_lattice(solver.model()));
  std::vector<SurfacePosition> positions;
  for_each_position<3>(solver, solution, [&](int position, const PositionFields<3>& fields) {
    if (all || position == worst) positions.push_back(on_points(fields, points));
  });
  return positions;
}

/// With all positions where the page holds them, else with the worst one.
LitWheel lit_wheel(const SolvedShape<3>& last) {
  LitWheel wheel{page_surface(last, last.solver->model().n_positions), {}};
  wheel.positions = lit_positions(wheel.surface, *last.solver, *last.solution);
  return wheel;
}

void add_fields(const Case& c, const SolvedShape<3>& last, ReportRun<3>& run) {
  LitWheel wheel = lit_wheel(last);
  run.surface = std::move(wheel.surface);
  run.positions = std::move(wheel.positions);
  for_other_loads<3>(c, *last.solution, [&](const std::string& name, const State<3>& state) {
    run.other_loads.push_back({name, lit_positions(run.surface, *last.solver, state)});
  });
}

}  // namespace

std::vector<ShapeOutline> read_outlines(const fs::path& folder) {
  const fs::path file = folder / outline_file;
  std::ifstream counted(file), stream(file);
  const auto n = static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(counted), std::istreambuf_iterator<char>(), '\n'));
  const std::size_t step = n / most_outlines + 1;
  std::vector<ShapeOutline> outlines;
  std::string line;
  for (std::size_t k = 0; std::getline(stream, line); ++k)
    if (k % step == 0 || k + 1 == n)
      if (auto outline = parse_outline_line(line)) outlines.push_back(*std::move(outline));
  return outlines;
}

template <int dim>
ReportRun<dim> report_of_folder(const fs::path& folder, const Case& c) {
  ReportRun<dim> run{.name = (fs::absolute(folder).lexically_normal() / "").parent_path().filename().string(),
                     .title = run_title(c),
                     .status = "running",
                     .is_running = true,
                     .program = program_text(),
                     .case_text = content(folder / "case.toml"),
                     .seconds = 0,
                     .load = load_text(rolling_model<dim>(c)),
                     .objective = shown_unit(c.objective.minimize, c.wheel),
                     .grid = polar_grid<dim>(c),
                     .trials = 0,
                     .rejected = {},
                     .events = {},
                     .history = {},
                     .outlines = read_outlines(folder),
                     .flags = {},
                     .limits = {},
                     .summary = {},
                     .surface = {},
                     .positions = {},
                     .contact_points = {}};
  read_history(folder / history_file, run);
  run.seconds = last_elapsed(run);
  std::erase_if(run.history, [](const HistoryCurve& curve) { return curve.name.ends_with("[s]"); });
  return run;
}

template <int dim>
ReportRun<dim> report_of_results(const fs::path& folder, const Case& c, const RunSummary<dim>& summary,
                                 const SolvedShape<dim>& last, std::optional<StopReason> reason) {
  ReportRun<dim> run = report_of_folder<dim>(folder, c);
  run.is_running = false;
  run.status = status_text(reason);
  run.flags = flags(c, summary, reason);
  run.limits = limits(c, summary.after.wheel);
  run.summary = summary;
  if (!summary.changed_start.empty())
    run.given = shape_outline(0, summary.before.objective ? *summary.before.objective : NAN,
                              mid_plane_section(initial_shape<dim>(c)));
  run.shape = last.shape;
  add_fields(c, last, run);
  run.contact_points = contact_points(*last.solver, *last.solution);
  return run;
}

template <int dim>
ReportRun<dim> report_without_results(const fs::path& folder, const Case& c, StopReason reason) {
  ReportRun<dim> run = report_of_folder<dim>(folder, c);
  run.is_running = false;
  run.status = status_text(reason);
  run.flags = {reason == StopReason::failed_start
                   ? "There is no wheel to show: " + first_line(folder / failure_report_file)
                   : "The run ended before its results were computed: `wheelwright report` computes them."};
  std::ranges::move(warnings(with_levels_of_results(c)), std::back_inserter(run.flags));
  return run;
}

template <int dim>
std::string loaded_wheel(const SolvedShape<dim>& solved, int position) {
  const PositionFields<dim> fields = position_fields(*solved.solver, *solved.solution, position);
  if constexpr (dim == 2) {
    return loaded_wheel_json(*solved.shape, std::span(&fields, 1));
  } else {
    const SurfaceMesh surface = page_surface(solved, 1);
    const SurfacePosition on_surface =
        on_points(fields, field_points(surface, displacement_lattice(solved.solver->model())));
    return loaded_wheel_json(surface, std::span(&on_surface, 1));
  }
}

template ReportRun<2> report_without_results(const fs::path&, const Case&, StopReason);
template ReportRun<3> report_without_results(const fs::path&, const Case&, StopReason);
template std::string loaded_wheel(const SolvedShape<2>&, int);
template std::string loaded_wheel(const SolvedShape<3>&, int);
template ReportRun<2> report_of_folder(const fs::path&, const Case&);
template ReportRun<3> report_of_folder(const fs::path&, const Case&);
template ReportRun<2> report_of_results(const fs::path&, const Case&, const RunSummary<2>&,
                                        const SolvedShape<2>&, std::optional<StopReason>);
template ReportRun<3> report_of_results(const fs::path&, const Case&, const RunSummary<3>&,
                                        const SolvedShape<3>&, std::optional<StopReason>);

}  // namespace wheelwright
