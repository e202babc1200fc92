#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/execute.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/guarded.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/case/shorten.h"
#include "wheelwright/files/path_queries.h"

namespace wheelwright {
namespace {

/// The case of a run, with the run's last shape as its initial one. Nothing, after a message, if there is
/// none.
std::optional<Case> case_from_run(const std::filesystem::path& folder) {
  auto c = read_or_report(folder / "case.toml");
  if (!c) return {};
  c->holes = {};
  c->shapes = {};
  c->expectations = {};
  c->saved_shape = {.from = std::filesystem::absolute(folder).string(), .checksum = {}, .shape = {}};
  const auto problems = load_saved_shape(*c, {});
  for (const FileProblem& problem : problems)
    print_err("{}: {}; {}\n", folder.string(), problem.problem, problem.remedy);
  if (!problems.empty()) return {};
  return c;
}

class RunCommand : public Subcommand {
 public:
  RunCommand() : Subcommand("run", "Optimize a case and write the results to its folder") {}

  void declare(Options& options) override {
    options.argument(
        "CASE", case_file_,
        "case file, or the folder of a run: the new run has its case and starts from its last shape");
    add_output(options, output_, "Folder for the results, instead of the case's output.folder");
    add_iterations(options, iterations_);
    add_threads(options, threads_);
    add_verbose(options, verbose_);
    add_events(options, events_);
  }

  int run() override {
    if (!events_) return optimize({verbose_ ? Detail::every_trial : Detail::progress});
    EventOutput events;
    return events.end(guarded("wheelwright run", [&] { return optimize({.events = &events}); }));
  }

 private:
  int optimize(const Reporting& reporting) {
    Signals signals;
    const bool from_run = is_folder(case_file_);
    if (from_run && !output_) {
      print_err("{}: give the new run's folder by --output; `wheelwright resume` continues this one\n",
                case_file_);
      return exit_usage;
    }
    auto c = from_run ? case_from_run(case_file_) : read_or_report(case_file_);
    if (!c) return exit_usage;
    if (iterations_) c = with_iterations(*std::move(c), *iterations_);
    if (!may_compute(name(), *c, case_file_, threads_)) return exit_refused;
    return begin_run(*c, output_.value_or(c->output.folder), signals, reporting);
  }

  std::string case_file_;
  std::optional<std::string> output_, events_;
  std::optional<int> iterations_, threads_;
  bool verbose_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_run() { return std::make_unique<RunCommand>(); }

}  // namespace wheelwright
