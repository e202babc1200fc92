#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/load_list.h"
#include "wheelwright/app/number_list.h"
#include "wheelwright/app/output_folder.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/base/text.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/report/heat_report.h"
#include "wheelwright/output/report/pass_report.h"
#include "wheelwright/output/report/pressure_plot.h"
#include "wheelwright/output/report/rolling_report.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/wheel_pictures.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/quantities/analysis/ground_pass.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/results/refined_numbers.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

constexpr const char* result_file = "analysis.json";

/// All files that are written to the folder: add the names of new files here.
constexpr std::string_view files_of_analysis[] = {
    "analysis.json",    "travel.svg",    "force.svg",   "peak_pressure.svg",
    "pressures.svg",    "pressures.csv", "pass.csv",    "loads.svg",
    "stiffness.svg",    "mesh.svg",      "stress.svg",  "stress_contact.svg",
    "displacement.svg", "pressure.svg",  "fatigue.svg", "temperature.svg"};

/// The case with the tread levels of another one.
Case with_levels_of(Case c, const Case& other) {
  c.grid.tread_levels = other.grid.tread_levels;
  return c;
}

/// Loads on the whole width [N]. The wheel's name replaces a missing title.
template <int dim>
RollingReport rolling_report(const WheelInput<dim>& wheel, const std::vector<double>& loads,
                             const StateSolver<dim>& solver, const State<dim>& solution,
                             const LoadCases<dim>& all_loads) {
  const Case& c = wheel.source;
  const std::string title = c.title.empty() ? wheel.name : c.title;
  RollingReport report{.title = fmt::format("{}, {}", title, wheel.which),
                       .width = c.wheel.width,
                       .n_sectors = c.wheel.sectors,
                       .analysis = rolling_analysis(solver, solution, print_contact_progress()),
                       .loads = {},
                       .under_loads = {},
                       .dimension = dim,
                       .finer = {}};
  report.losses = rolling_losses(solver, wheel.shape, solution);
  report.outer_radius = c.wheel.outer_radius;
  report.is_ground_flat = solver.model().ground.is_flat();
  report.is_linear = solver.model().materials.are_linear();
  report.fatigue = fatigue_results(solver, wheel.shape, solution);
  report.damage = fatigue_damage(solver, wheel.shape, solution, all_loads, print_contact_progress());
  for (const auto& load_case : all_loads) report.load_cases.push_back(load_case.name);
  report.heat = heat_results(solver, wheel.shape, solution);
  for (const double load : loads) report.loads.push_back(load / whole_width(dim, c.wheel.width));
  report.under_loads = under_loads<dim>(solution, report.loads, print_contact_progress());
  return report;
}

/// The analysis under the same loads on the finer grid.
template <int dim>
Expected<FinerReport, std::string> finer_report(const Expected<SolvedFinerShape<dim>, std::string>& finer,
                                                const std::vector<double>& loads,
                                                const LoadCases<dim>& all_loads) {
  if (!finer) return finer.failure();
  return FinerReport{
      rolling_analysis(*finer->solver, *finer->states, print_contact_progress()),
      under_loads<dim>(*finer->states, loads, print_contact_progress()),
      finer->refinement,
      rolling_losses<dim>(*finer->solver, finer->shape, *finer->states),
      fatigue_results<dim>(*finer->solver, finer->shape, *finer->states),
      fatigue_damage<dim>(*finer->solver, finer->shape, *finer->states, all_loads, print_contact_progress()),
      heat_results<dim>(*finer->solver, finer->shape, *finer->states)};
}

std::vector<std::string> warnings_of_heat(const RollingReport& report) {
  if (!report.heat || !*report.heat) return {};
  std::vector<std::string> layers;
  for (const LayerResults& layer : report.analysis.layers) layers.push_back(layer.name);
  return too_warm(**report.heat, layers);
}

void write_plots(const std::filesystem::path& folder, const RollingReport& report) {
  const auto plot = [&](const char* file, const LinePlot& picture) {
    write_atomically(folder / file, plot_svg(picture));
  };
  if (report.analysis.travel_at_load) plot("travel.svg", travel_plot(report));
  if (report.analysis.force_at_travel) plot("force.svg", force_plot(report));
  plot("peak_pressure.svg", peak_pressure_plot(report));
  if (report.loads.empty()) return;
  plot("loads.svg", load_plot(report));
  plot("stiffness.svg", stiffness_plot(report));
}

/// The contact of all positions, and pictures of the loaded wheel.
template <int dim>
void write_fields(const std::filesystem::path& folder, const RollingReport& report,
                  const LevelSet<dim>& shape, const StateSolver<dim>& solver, const State<dim>& states,
                  const LoadCases<dim>& all_loads, SideFace shown) {
  const auto points = contact_points(solver, states);
  if constexpr (dim == 2)
    write_atomically(folder / "pressures.svg",
                     plot_svg(pressure_plot(points, report.analysis.azimuths, "Contact pressure")));
  write_pressure_csv<dim>(folder / "pressures.csv", points);
  write_wheel_pictures(folder,
                       {.prefix = "",
                        .title = report.title,
                        .width = report.width,
                        .n_positions = solver.model().n_positions,
                        .shown = shown},
                       shape, states.domain(), most_stressed_fields(solver, states, all_loads),
                       turn_peaks<dim>(report.fatigue, report.damage, report.heat));
}

std::string check_loads(const std::string& text) {
  return parse_loads(text)
             ? ""
             : "must be loads > 0: a list as in 1000,2000, or the first, the last and how many, "
               "as in 500:3000:6";
}

std::string check_pass(const std::string& text) {
  return parse_number_list(text) ? ""
                                 : "must be places: a list as in -0.1,0,0.1, or the first, the last and how "
                                   "many, as in -0.2:0.2:41";
}

/// "0.5%" or "0.005", between 0 and 1.
std::optional<double> parse_accuracy(std::string_view text) {
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.remove_suffix(1);
  const auto numbers = parse_number_list(text);
  if (!numbers || numbers->size() != 1) return {};
  const double value = numbers->front() / (is_percent ? 100 : 1);
  return value > 0 && value < 1 ? std::optional(value) : std::nullopt;
}

std::string check_accuracy(const std::string& text) {
  return parse_accuracy(text) ? "" : "must be a fraction of each number, as in 0.5% or 0.005";
}

class AnalyzeCommand : public Subcommand {
 public:
  AnalyzeCommand() : Subcommand("analyze", "Report stiffness, contact, stress and run-out of one shape") {}

  void declare(Options& options) override {
    constexpr int max_positions = 1000;
    add_wheel(options, input_);
    options.number("--positions", positions_, {1, max_positions}, "Load positions per sector");
    options.text("--loads", "P1,P2,... | FROM:TO:NUMBER", loads_, check_loads,
                 "Report the deflection under these loads on the whole width [N]");
    options.text(
        "--pass", "X1,X2,... | FROM:TO:NUMBER", pass_, check_pass,
        "Report the forces while a bar, kerb or profile passes below: by so much it has moved along the "
        "ground [m]");
    options.text(
        "--load-case", "NAME", load_case_, [](const std::string&) { return ""; },
        "Compute the wheel under this [[load.case]] instead of the first one");
    add_output(options, output_, "Folder for JSON and plots; without it only the table is printed");
    options.flag("--json", json_, "Print JSON instead of the table");
    add_without_errors(options, without_errors_);
    options.text("--accuracy", "PERCENT%", accuracy_, check_accuracy,
                 "Solve on finer grids until every number is this accurate, or say why it is not; grids have "
                 "at most 5e6 unknowns, in 3D 1e6");
    add_threads(options, threads_);
  }

  int run() override {
    auto wheel = read_wheel_or_report(input_, {name(), threads_, positions_});
    if (!wheel) return wheel.failure();
    if (output_ && !may_write_to(*output_, files_of_analysis)) return exit_refused;
    const Case given = std::visit([](const auto& input) { return input.source; }, *wheel);
    if (!take_load_case(*wheel)) return exit_refused;
    if (pass_ &&
        std::visit([](const auto& input) { return ground_of(input.source.load).is_even(); }, *wheel)) {
      print_err("{}: --pass needs a load whose load.ground is a bar, a kerb or a profile\n", name());
      return exit_refused;
    }
    return std::visit([&](const auto& input) { return analyze(input, given); }, *wheel);
  }

 private:
  std::filesystem::path folder() const { return *output_; }

  /// Reduces the case to the requested load case; false, after a message, if there is none of that name.
  bool take_load_case(AnyWheel& wheel) const {
    return std::visit(
        [&](auto& input) {
          const auto& cases = input.source.load.cases;
          const auto found =
              load_case_ ? std::ranges::find(cases, *load_case_, &CaseLoad::name) : cases.begin();
          if (found == cases.end()) {
            if (load_case_)
              print_err("{}: the case has no [[load.case]] named {}\n", name(),
                        without_control_characters(*load_case_));
            return !load_case_;
          }
          input.which += ", load case " + found->name;
          input.source = with_load_case(input.source, static_cast<int>(found - cases.begin()));
          return true;
        },
        wheel);
  }

  /// Computes the shape at its load positions and reports the quantities of interest; the fatigue under all
  /// load cases too if the case as given has their shares of the distance and no load case is requested.
  template <int dim>
  int analyze(const WheelInput<dim>& wheel, const Case& given) const {
    const Case& c = wheel.source;
    const LoadCases<dim> all_loads = load_case_ ? LoadCases<dim>() : load_cases<dim>(given);
    const bool knows_shares = !distance_shares(all_loads).empty();
    const Case all = with_levels_of_results(knows_shares ? given : c);
    const auto made = make_solver(rolling_model<dim>(all));
    if (!made) return report_failure(name(), made.failure());
    const StateSolver<dim>& solver = **made;
    const LevelSet<dim>& shape = wheel.shape;
    const auto solved = solved_without_overlap(solver, shape);
    if (!solved) {
      const int code = report_failure(name(), solved.failure());
      if (const auto lighter = under_smallest_load(wheel)) analyze_instead(*lighter);
      return code;
    }
    RollingReport report = rolling_report(wheel, loads(), solver, **solved, all_loads);
    if (!without_errors_ || accuracy_)
      add_accuracy(with_levels_of(c, all), solver, shape, solved, all_loads, report);
    if (pass_) report.pass = ground_pass<dim>(**solved, *parse_number_list(*pass_));
    print_report(report);
    const auto size = deformation_size<dim>(solver, shape, **solved, report.analysis.deformations);
    if (const std::string warning = deformation_warning(size); !warning.empty())
      warn_about(wheel.name, warning);
    for (const std::string& warning : warnings_of_heat(report)) warn_about(wheel.name, warning);
    if (output_) write(report, shape, solver, **solved, all_loads, shown_side_face(c));
    return exit_done;
  }

  template <int dim>
  static SolvedStates<dim> solved_without_overlap(const StateSolver<dim>& solver,
                                                  const LevelSet<dim>& shape) {
    auto solved = solver.states(shape, solver.all_positions(), print_contact_progress());
    if (!solved) return solved;
    if (const auto failure = material_overlaps(solver, shape, **solved)) return *failure;
    return solved;
  }

  /// The wheel under the smallest of --loads if that is less than its own; its load or travel is too large.
  template <int dim>
  std::optional<WheelInput<dim>> under_smallest_load(const WheelInput<dim>& wheel) const {
    if (!loads_) return {};
    const double smallest = std::ranges::min(loads());
    if (!wheel.source.load.travel && smallest >= wheel.source.load.force) return {};
    WheelInput<dim> lighter = wheel;
    lighter.source.load.force = smallest;
    lighter.source.load.travel.reset();
    return lighter;
  }

  template <int dim>
  void analyze_instead(const WheelInput<dim>& lighter) const {
    print_err("wheelwright {}: what follows is under {:g} N, the smallest of --loads\n", name(),
              lighter.source.load.force);
    analyze(lighter, lighter.source);
  }

  /// Adds what finer grids say about the numbers. `c` has the tread levels of the solver.
  template <int dim>
  void add_accuracy(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                    const SolvedStates<dim>& states, const LoadCases<dim>& all_loads,
                    RollingReport& report) const {
    auto finer = solved_finer_shape(c, solver, shape, print_contact_progress());
    if (!without_errors_) report.finer = finer_report(finer, report.loads, all_loads);
    if (accuracy_)
      report.accurate = refined_numbers(c, solver, shape, states, std::move(finer),
                                        *parse_accuracy(*accuracy_), print_contact_progress());
  }

  std::vector<double> loads() const { return loads_ ? *parse_loads(*loads_) : std::vector<double>(); }

  void print_report(const RollingReport& report) const {
    print_lines(stdout, json_ ? rolling_json(report)
                              : without_control_characters(report.title) + "\n\n" + rolling_table(report));
  }

  template <int dim>
  void write(const RollingReport& report, const LevelSet<dim>& shape, const StateSolver<dim>& solver,
             const State<dim>& states, const LoadCases<dim>& all_loads, SideFace shown) const {
    make_folder(folder());
    write_plots(folder(), report);
    write_fields(folder(), report, shape, solver, states, all_loads, shown);
    if (!report.pass.empty())
      write_atomically(folder() / "pass.csv", pass_csv(report.pass, whole_width(dim, report.width)));
    write_atomically(folder() / result_file, rolling_json(report));
  }

  std::string input_;
  int positions_ = 64;
  std::optional<std::string> loads_, pass_, load_case_, output_, accuracy_;
  std::optional<int> threads_;
  bool json_ = false, without_errors_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_analyze() { return std::make_unique<AnalyzeCommand>(); }

}  // namespace wheelwright
