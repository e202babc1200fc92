#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/execute.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/guarded.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/shorten.h"
#include "wheelwright/files/path_queries.h"

namespace wheelwright {
namespace {

class ResumeCommand : public Subcommand {
 public:
  ResumeCommand() : Subcommand("resume", "Resume a run that was stopped") {}

  void declare(Options& options) override {
    options.argument("DIR", folder_, not_empty, "folder of the run");
    add_iterations(options, iterations_);
    add_threads(options, threads_);
    add_verbose(options, verbose_);
    add_events(options, events_);
  }

  int run() override {
    if (!events_) return resume({verbose_ ? Detail::every_trial : Detail::progress});
    EventOutput events;
    return events.end(guarded("wheelwright resume", [&] { return resume({.events = &events}); }));
  }

 private:
  int resume(const Reporting& reporting) {
    Signals signals;
    const std::filesystem::path case_file = std::filesystem::path(folder_) / "case.toml";
    if (!is_there(case_file)) {
      print_err("{}: this folder contains no run: {} is missing or cannot be read\n", folder_,
                case_file.string());
      return exit_usage;
    }
    auto c = read_or_report(case_file);
    if (!c) return exit_usage;
    if (iterations_) c = with_iterations(*std::move(c), *iterations_);
    if (!may_compute(name(), *c, case_file, threads_)) return exit_refused;
    return resume_run(*c, folder_, signals, reporting);
  }

  std::string folder_;
  std::optional<std::string> events_;
  std::optional<int> iterations_, threads_;
  bool verbose_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_resume() { return std::make_unique<ResumeCommand>(); }

}  // namespace wheelwright
