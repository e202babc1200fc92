#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/execute.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/case/shorten.h"

namespace wheelwright {
namespace {

class RunCommand : public Subcommand {
 public:
  RunCommand() : Subcommand("run", "Optimize a case and write the results to its folder") {}

  void declare(Options& options) override {
    add_case(options, case_file_);
    add_output(options, output_, "Folder for the results, instead of the case's output.folder");
    add_iterations(options, iterations_);
    add_threads(options, threads_);
  }

  int run() override {
    Signals signals;
    auto c = read_or_tell(case_file_);
    if (!c) return exit_usage;
    if (iterations_) c = with_iterations(*std::move(c), *iterations_);
    if (!may_compute(name(), *c, case_file_, threads_)) return exit_refused;
    return begin_run(*c, output_.value_or(c->output.folder), signals);
  }

 private:
  std::string case_file_;
  std::optional<std::string> output_;
  std::optional<int> iterations_, threads_;
};

}  // namespace

std::unique_ptr<Subcommand> make_run() { return std::make_unique<RunCommand>(); }

}  // namespace wheelwright
