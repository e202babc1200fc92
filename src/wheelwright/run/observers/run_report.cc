#include "wheelwright/run/observers/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/run/checkpoints/history.h"
#include "wheelwright/run/checkpoints/provenance.h"
#include "wheelwright/run/observers/failure_report.h"
#include "wheelwright/run/results/bounded_peaks.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/run/results/stop_text.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/feature_warnings.h"
#include "wheelwright/run/study/roughness_warning.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/section.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

double number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Consecutive rows, evenly thinned to at most twice `most`, including the first and the last one.
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

/// The newest events of the holes.
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

/// The numeric columns of the accepted shapes, thinned if there are thousands, the number of trials, the
/// reasons of rejections, and recent events of the holes.
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
  run.events_omitted = newest_events.left_out();
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

/// `of_roughness` is empty if the edges are smooth.
template <int dim>
std::vector<std::string> flags(const Case& c, const RunSummary<dim>& summary, const std::string& of_roughness,
                               std::optional<StopReason> reason) {
  const DescribedWheel<dim>& wheel = summary.after.wheel;
  std::vector<std::string> result;
  for (const SummarizedBound& bound : summary.bounds)
    if (!bound.is_kept)
      result.push_back(fmt::format("The bound {} {} {:.6g} {} is not kept: the value is {:.6g} {}.",
                                   bound.name, bound.relation, bound.bound * bound.shown.factor,
                                   bound.shown.name, bound.value * bound.shown.factor, bound.shown.name));
  for (const SummarizedBound& bound : summary.bounds)
    if (std::string warning = finer_grid_warning(bound); !warning.empty())
      result.push_back(std::move(warning));
  if (wheel.loaded)
    if (const auto warning = deformation_warning(wheel.loaded->deformation); !warning.empty())
      result.push_back(warning);
  for (const std::string& warning : too_warm(wheel)) result.push_back(warning + ".");
  if (wheel.outline)
    for (const std::string& warning : feature_warnings(c, *wheel.outline)) result.push_back(warning);
  if (!of_roughness.empty()) result.push_back(of_roughness);
  for (const std::string& warning : warnings(with_levels_of_results(c))) result.push_back(warning);
  for (const std::string& line : missing_lines(summary)) result.push_back(line);
  for (const Remark& remark : summary.remarks) result.push_back(text(remark));
  for (const ChosenRadius& radius : summary.radii) result.push_back(text(radius));
  if (const std::string warning = summary.made ? making_warning(*summary.made) : ""; !warning.empty())
    result.push_back(warning);
  if (!summary.changed_start.empty()) result.push_back(summary.changed_start);
  if (reason == StopReason::iterations && convergence_tolerance(c) > 0)
    result.push_back(
        "The run ended by its number of shapes before it converged: more shapes may improve the wheel.");
  if (reason == StopReason::gave_up)
    result.push_back(
        "The run gave up: the file failure/report.txt says why. The shape shown is the last accepted one.");
  if (!reason || reason == StopReason::stop_requested)
    result.push_back("The run has not ended by itself: more shapes may improve the wheel.");
  return result;
}

/// The limitations of the numbers.
template <int dim>
std::vector<std::string> limits(const Case& c, const DescribedWheel<dim>& wheel) {
  const Case shown = with_levels_of_results(c);
  const bool is_large = has_large_strains(c);
  std::vector<std::string> result{
      fmt::format("The material is {}elastic: no creep, and the same when it is warm{}. Whether it "
                  "withstands the peak stress is not assessed.",
                  is_large ? "" : "linear ", has_fatigue_limit(c) ? "" : ", no fatigue")};
  if (is_large)
    result.push_back(
        "Deformations are computed at their true size; edges of holes that meet are not in contact. How much "
        "more load the wheel carries is not known: `wheelwright analyze` shows it with --loads.");
  else if (wheel.loaded)
    result.push_back(fmt::format(
        "Deformations are taken as small: this makes an error of about {:.2g} % in travel and stiffness, "
        "estimated from the computed deformation.",
        100 * wheel.loaded->deformation.error.size()));
  result.push_back(
      fmt::format("Rolling is a sequence of {} load positions per sector, each in equilibrium: no inertia{}.",
                  c.load.positions, has_loss_factor(c) ? "" : ", no rolling resistance"));
  if (const std::string peaks = bounded_peaks(c); !peaks.empty()) result.push_back(peaks);
  if (dim == 2)
    result.push_back(
        fmt::format("The wheel and its load are constant over the width ({}): forces along the axle and "
                    "effects of the side faces are neglected.",
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

/// The wheel under the load cases after the first one.
template <int dim>
std::vector<LoadedPositions<dim>> other_loads(const Case& c, const SolvedShape<dim>& last) {
  const LoadCases<dim> cases = load_cases<dim>(c);
  std::vector<LoadedPositions<dim>> all;
  for (std::size_t k = 1; k < cases.size(); ++k)
    if (const auto state =
            last.solution->under(with_loads(last.solution->model(), cases[k].model), Interrupt()))
      all.push_back({cases[k].name, shown_wheel<dim>({last.shape, last.solver, state->get()}).positions});
  return all;
}

}  // namespace

std::vector<ShapeOutline> read_outlines(const fs::path& folder) {
  const fs::path file = folder / outline_file;
  std::ifstream counted(file), stream(file);
  const auto n = static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(counted), std::istreambuf_iterator<char>(), '\n'));
  const std::size_t step = n / max_outlines + 1;
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
                     .load = load_text(rolling_model<dim>(c)),
                     .objective = shown_unit(c.objective.minimize, c.wheel),
                     .grid = polar_grid<dim>(c),
                     .layers = layer_circles(materials<dim>(c)),
                     .outlines = read_outlines(folder)};
  read_history(folder / history_file, run);
  run.seconds = last_elapsed(run);
  std::erase_if(run.history, [](const HistoryCurve& curve) { return curve.name.ends_with("[s]"); });
  return run;
}

template <int dim>
ReportRun<dim> report_of_results(const fs::path& folder, const Case& c, const RunSummary<dim>& summary,
                                 const SolvedShape<dim>& last, ShownWheel<dim> wheel,
                                 std::optional<StopReason> reason) {
  ReportRun<dim> run = report_of_folder<dim>(folder, c);
  run.is_running = false;
  run.status = status_text(reason);
  const std::string of_roughness =
      roughness_warning(c, roughness(summary.after.wheel), roughness(summary.before.wheel));
  run.flags = flags(c, summary, of_roughness, reason);
  run.has_rough_edges = !of_roughness.empty();
  run.limits = limits(c, summary.after.wheel);
  run.summary = summary;
  if (!summary.changed_start.empty())
    run.given = shape_outline(0, summary.before.objective ? *summary.before.objective : NAN,
                              mid_plane_section(initial_shape<dim>(c)));
  run.wheel = std::move(wheel);
  run.other_loads = other_loads(c, last);
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

template decltype(report_without_results<2>) report_without_results<2>;
template decltype(report_without_results<3>) report_without_results<3>;
template decltype(report_of_folder<2>) report_of_folder<2>;
template decltype(report_of_folder<3>) report_of_folder<3>;
template decltype(report_of_results<2>) report_of_results<2>;
template decltype(report_of_results<3>) report_of_results<3>;

}  // namespace wheelwright
