#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/slow_stage.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/checked_case.h"
#include "wheelwright/run/study/feature_warnings.h"
#include "wheelwright/run/study/filled_holes.h"
#include "wheelwright/run/study/fitting.h"
#include "wheelwright/run/study/loose_material.h"
#include "wheelwright/run/study/plane_comparison.h"
#include "wheelwright/run/study/predicted_bounds.h"
#include "wheelwright/run/study/predicted_deformation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

class CheckCommand : public Subcommand {
 public:
  CheckCommand() : Subcommand("check", "Report all problems of a case, or the values derived from it") {}

  void declare(Options& options) override {
    add_case(options, case_file_);
    options.flag("--json", json_, "Print JSON instead of the report");
  }

  int run() override {
    const CheckedCase checked = check();
    if (json_)
      print_lines(stdout, check_json(checked));
    else
      print_report(checked);
    return checked.value ? exit_done : exit_usage;
  }

 private:
  CheckedCase check() const {
    CaseResult read = read_case_file(case_file_);
    CheckedCase checked{
        .file = case_file_, .value = std::move(read.value), .problems = std::move(read.problems)};
    if (!checked.value) return checked;
    if (const auto lack = lack_of_memory(*checked.value, available_memory())) {
      checked.notes.push_back(derived_report(*checked.value));
      checked.warnings = warnings(*checked.value);
      checked.warnings.push_back("this case cannot run here: " + *lack);
      return checked;
    }
    checked.problems = problems_of_initial_shape(*checked.value);
    if (checked.problems.empty())
      examine(*checked.value, checked);
    else
      checked.value.reset();
    return checked;
  }

  /// Finds the problems that only the drawn shape shows.
  std::vector<Diagnostic> problems_of_initial_shape(const Case& c) const {
    std::vector<Diagnostic> problems;
    const auto add = [&](const std::string& problem) {
      problems.push_back(
          {.kind = Diagnostic::Kind::conflict, .file = case_file_, .problem = problem, .remedy = {}});
    };
    for (const std::string& piece : loose_material(c)) add(piece);
    if (!problems.empty()) return problems;
    const auto filled = in_dimension_of(
        c, [&](auto dim) { return filled_holes(initial_shape<dim>(c), evolution_options(c)); });
    if (filled) add(filled->detail);
    return problems;
  }

  /// Adds what can be said of a case without problems.
  static void examine(const Case& c, CheckedCase& checked) {
    const auto warn = [&](const std::optional<std::string>& text) {
      if (text) checked.warnings.push_back(*text);
    };
    checked.notes.push_back(derived_report(c));
    if (const auto change =
            in_dimension_of(c, [&](auto dim) { return volume_change_of_saved_shape<dim>(c); }))
      checked.notes.push_back(text(*change) + '\n');
    if (const auto made = in_dimension_of(c, [&](auto dim) { return made_wheel(c, initial_shape<dim>(c)); }))
      if (const std::string how = text(*made); !how.empty())
        checked.notes.push_back(fmt::format("  {:<22}{}\n", made->how, how));
    const auto measures = initial_outline_measures(c);
    if (measures) checked.clearances = measures->clearances;
    if (measures) checked.notes.push_back(clearance_report(measures->clearances));
    const auto planes = plane_comparison(c);
    if (planes && *planes) checked.notes.push_back(comparison_text(c, **planes));
    const auto predicted = predictions(c);
    if (const std::string note = prediction_note(predicted); !note.empty()) checked.notes.push_back(note);
    const PredictedBounds bounds = predicted_bounds(c);
    if (!bounds.note.empty()) checked.notes.push_back(bounds.note);
    checked.warnings = warnings(c);
    warn(in_dimension_of(c, [&](auto dim) { return fitting_of_initial_shape<dim>(c); }));
    if (planes && *planes) warn(plane_warning(c, **planes));
    warn(prediction_warning(predicted));
    for (const std::string& warning : bounds.warnings) warn(warning);
    if (!measures) warn("walls and gaps were not measured: " + measures.failure().what);
    if (measures)
      for (const std::string& warning : feature_warnings(c, *measures)) warn(warning);
  }

  void print_report(const CheckedCase& checked) const {
    if (!checked.value) return print_problems(case_file_, checked.problems);
    print("{}\n", styled(stdout, Style::green, case_file_ + ": no problems"));
    for (const std::string& note : checked.notes) print_lines(stdout, note);
    for (const std::string& warning : checked.warnings) print_warning(stdout, warning);
  }

  static std::optional<Expected<PlaneComparison>> plane_comparison(const Case& c) {
    if (c.wheel.dimension == 3 || c.contact.with != Counterpart::ground) return {};
    const SlowStage stage("comparing plane strain and plane stress with three dimensions, on a coarse grid");
    return compare_planes(c, print_contact_progress());
  }

  static std::vector<PredictedDeformation> predictions(const Case& c) {
    const SlowStage stage("solving the initial wheel, on a coarse grid");
    return predicted_deformations(c, print_contact_progress());
  }

  std::string case_file_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_check() { return std::make_unique<CheckCommand>(); }

}  // namespace wheelwright
