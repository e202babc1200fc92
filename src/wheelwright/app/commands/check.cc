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
#include "wheelwright/run/study/bound_warnings.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/feature_warnings.h"
#include "wheelwright/run/study/filled_holes.h"
#include "wheelwright/run/study/loose_material.h"
#include "wheelwright/run/study/plane_comparison.h"
#include "wheelwright/run/study/predicted_deformation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

class CheckCommand : public Subcommand {
 public:
  CheckCommand() : Subcommand("check", "Report all problems of a case, or the values derived from it") {}

  void declare(Options& options) override { add_case(options, case_file_); }

  int run() override {
    const auto c = read_or_report(case_file_);
    if (!c) return exit_usage;
    const auto lack = lack_of_memory(*c, available_memory());
    const auto loose = lack ? std::vector<std::string>() : loose_material(*c);
    for (const std::string& piece : loose) print_err("{}: {}\n", case_file_, piece);
    if (!loose.empty()) return exit_usage;
    const auto filled = lack ? std::nullopt : in_dimension_of(*c, [&](auto dim) {
      return filled_holes(initial_shape<dim>(*c), evolution_options(*c));
    });
    if (filled) {
      print_err("{}: {}\n", case_file_, filled->detail);
      return exit_usage;
    }
    print("{}\n", styled(stdout, Style::green, case_file_ + ": no problems"));
    print_lines(stdout, derived_report(*c));
    if (lack) {
      print_warnings(stdout, *c);
      print_warning(stdout, "this case cannot run here: " + *lack);
      return exit_done;
    }
    const auto change = in_dimension_of(*c, [&](auto dim) { return volume_change_of_saved_shape<dim>(*c); });
    if (change) print("{}\n", text(*change));
    const auto measures = initial_outline_measures(*c);
    if (measures) print_lines(stdout, clearance_report(measures->clearances));
    const auto planes = plane_comparison(*c);
    if (planes && *planes) print_lines(stdout, comparison_text(**planes));
    print_warnings(stdout, *c);
    if (planes && *planes)
      if (const auto warning = plane_warning(*c, **planes)) print_warning(stdout, *warning);
    if (const auto warning = predicted_warning(*c)) print_warning(stdout, *warning);
    for (const std::string& warning : bound_warnings(*c)) print_warning(stdout, warning);
    if (!measures) print_warning(stdout, "walls and gaps were not measured: " + measures.failure().what);
    if (measures)
      for (const std::string& warning : feature_warnings(*c, *measures)) print_warning(stdout, warning);
    return exit_done;
  }

 private:
  static std::optional<Expected<PlaneComparison>> plane_comparison(const Case& c) {
    if (c.wheel.dimension == 3 || c.contact.with != Counterpart::ground) return {};
    const SlowStage stage("comparing plane strain and plane stress with three dimensions, on a coarse grid");
    return compare_planes(c, print_contact_progress());
  }

  static std::optional<std::string> predicted_warning(const Case& c) {
    const SlowStage stage("solving the initial wheel, on a coarse grid");
    return predicted_deformation(c, print_contact_progress());
  }

  std::string case_file_;
};

}  // namespace

std::unique_ptr<Subcommand> make_check() { return std::make_unique<CheckCommand>(); }

}  // namespace wheelwright
