#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/run/observers/run_report.h"
#include "wheelwright/run/results/final_results.h"
#include "wheelwright/run/results/given_wheel.h"
#include "wheelwright/run/results/summarized_run.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

/// Solves the given wheel and the last shape of a run again, for results that its folder does not keep.
template <int dim>
Expected<PageRun> report_of_run(const RunInput<dim>& run) {
  const auto study = make_study<dim>(run.source);
  if (!study) return study.failure();
  const auto made = make_solver(rolling_model<dim>(with_levels_of_results(run.source)));
  if (!made) return made.failure();
  const StateSolver<dim>& solver = **made;
  const auto solved = [&](const LevelSet<dim>& shape, const StateSolver<dim>& by) {
    return by.states(shape, distinct_positions(by, study->load_cases, shape), print_contact_progress());
  };
  const Study<dim> given = given_study(*study, run.checkpoint.initial);
  const auto made_for_given = make_solver(rolling_model<dim>(with_levels_of_results(given.source)));
  if (!made_for_given) return made_for_given.failure();
  const OptimizationState<dim>& last = run.checkpoint.state;
  const auto last_states = solved(last.shape, solver);
  if (!last_states) return last_states.failure();
  const auto summary = summarized_run(
      *study, given, run.checkpoint.initial,
      objective_as_given(given, run.checkpoint.initial, print_contact_progress()),
      described(given.source, **made_for_given, given.load_cases, given.initial,
                material_measure(given.initial), solved(given.initial, **made_for_given)),
      last, described(run.source, solver, study->load_cases, last.shape, last.measure, last_states));
  const SolvedShape<dim> shape{&last.shape, &solver, last_states->get()};
  return page_run(report_of_results<dim>(run.folder, run.source, summary, shape, shown_wheel(shape),
                                         run.checkpoint.finished));
}

/// The page of an exploration or a sweep; its points link to the reports of the designs.
std::optional<std::filesystem::path> page_of_designs(const std::filesystem::path& folder) {
  for (const char* name : {"explore.html", "sweep.html"})
    if (is_there(folder / name)) return folder / name;
  return {};
}

class ReportCommand : public Subcommand {
 public:
  ReportCommand() : Subcommand("report", "Write a page that explains one or more runs") {}

  void declare(Options& options) override {
    options.arguments("RUN", folders_, 1,
                      "Folders of runs; several are shown side by side. For an exploration or a sweep, "
                      "prints where its page is");
    options.text("--output", "FILE", output_, not_empty, "The file to write; default report.html");
    add_threads(options, threads_);
  }

  int run() override {
    if (const auto page = page_of_designs(folders_.front()); page && folders_.size() == 1) {
      fmt::print("{}\n", page->string());
      return exit_done;
    }
    const std::string file = output_.value_or("report.html");
    if (is_there(file)) {
      print_err("{}: exists already; choose another file with --output, or remove it\n", file);
      return exit_refused;
    }
    std::vector<PageRun> runs;
    std::vector<AnyRun> inputs;
    for (const std::string& folder : folders_) {
      auto input = read_run_or_report(folder, {name(), threads_});
      if (!input) return input.failure();
      inputs.push_back(*std::move(input));
    }
    for (const AnyRun& input : inputs) {
      auto report = std::visit([](const auto& run) { return report_of_run(run); }, input);
      if (!report) return report_failure(name(), report.failure());
      runs.push_back(*std::move(report));
    }
    write_atomically(file, report_page(runs));
    fmt::print("{}\n", file);
    return exit_done;
  }

 private:
  std::vector<std::string> folders_;
  std::optional<std::string> output_;
  std::optional<int> threads_;
};

}  // namespace

std::unique_ptr<Subcommand> make_report() { return std::make_unique<ReportCommand>(); }

}  // namespace wheelwright
