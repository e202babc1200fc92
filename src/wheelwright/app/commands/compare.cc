#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/output_folder.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/report/wheel_comparison.h"
#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

/// All files that are written to the folder: add the names of new files here.
constexpr std::string_view files_of_comparison[] = {"comparison.txt", "comparison.json", "comparison.svg"};

/// The wheel on the next finer grid, at all load positions.
KnownFinerWheel<2> finer_wheel_of(const Case& c, const LoadCases<2>& cases, const StateSolver<2>& solver,
                                  const LevelSet<2>& shape) {
  const auto finer = solved_finer_shape(c, solver, shape, print_contact_progress());
  if (!finer) return finer.failure();
  return finer_wheel<2>(c, cases, *finer, SolvedStates<2>(finer->states));
}

/// Solves a wheel at its load positions, and for the errors of its numbers on a finer grid too.
Expected<ComparedWheel> compared(const WheelInput<2>& wheel, bool wants_errors) {
  const Case c = with_levels_of_results(wheel.source);
  const auto solver = make_solver(rolling_model<2>(c));
  if (!solver) return solver.failure();
  const LevelSet<2>& shape = wheel.shape;
  const auto states = (*solver)->states(shape, (*solver)->all_positions(), print_contact_progress());
  if (!states) return states.failure();
  const PolarGrid<2>& grid = shape.lattice.grid();
  const auto cases = load_cases<2>(c);
  auto numbers =
      described_wheel(**solver, shape, volume_fraction(grid, material_measure(shape)), states, cases);
  if (wants_errors) numbers = with_errors(std::move(numbers), finer_wheel_of(c, cases, **solver, shape));
  numbers.name = wheel.name;
  numbers.which = wheel.which;
  return ComparedWheel{std::move(numbers),
                       material_contours(shape, contour_subdivisions(shape.lattice.degree()))};
}

class CompareCommand : public Subcommand {
 public:
  CompareCommand() : Subcommand("compare", "Compare wheels: their numbers and overlaid outlines") {}

  void declare(Options& options) override {
    constexpr int max_positions = 1000;
    options.arguments("WHEEL", inputs_, 2,
                      "Case files, for their initial shapes, or runs' folders, for their last shapes");
    options.number("--positions", positions_, {1, max_positions}, "Load positions per sector");
    add_output(options, output_,
               "Folder for comparison.txt, .json and .svg; without it the table is printed");
    options.flag("--json", json_, "Print JSON instead of the table");
    add_without_errors(options, without_errors_);
    add_threads(options, threads_);
  }

  int run() override {
    std::vector<WheelInput<2>> wheels;
    for (const std::string& input : inputs_) {
      auto wheel = read_plane_wheel_or_report(input, {name(), threads_, positions_});
      if (!wheel) return wheel.failure();
      wheels.push_back(*std::move(wheel));
    }
    if (output_ && !may_write_to(*output_, files_of_comparison)) return exit_refused;
    return compare(wheels);
  }

 private:
  int compare(const std::vector<WheelInput<2>>& inputs) const {
    std::vector<ComparedWheel> wheels;
    for (const WheelInput<2>& input : inputs) {
      auto wheel = compared(input, !without_errors_);
      if (!wheel) {
        print_err("{}:\n", input.name);
        return report_failure(name(), wheel.failure());
      }
      wheels.push_back(*std::move(wheel));
    }
    print_lines(stdout, json_ ? wheels_json(wheels) : wheels_table(wheels));
    if (output_) write(wheels);
    return exit_done;
  }

  void write(const std::vector<ComparedWheel>& wheels) const {
    const std::filesystem::path folder = *output_;
    make_folder(folder);
    write_atomically(folder / "comparison.txt", wheels_table(wheels));
    write_atomically(folder / "comparison.json", wheels_json(wheels));
    write_atomically(folder / "comparison.svg", overlay_svg(wheels));
  }

  std::vector<std::string> inputs_;
  int positions_ = 64;
  std::optional<std::string> output_;
  std::optional<int> threads_;
  bool json_ = false, without_errors_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_compare() { return std::make_unique<CompareCommand>(); }

}  // namespace wheelwright
