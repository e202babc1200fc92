#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/design_session.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/lock_warning.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/design/explore/plan.h"

namespace wheelwright {
namespace {

class DesignsCommand : public Subcommand {
 public:
  DesignsCommand()
      : Subcommand("designs", "Run planned designs, on any number of machines, and collect them") {}

  void declare(Options& options) override {
    constexpr int max_designs = 999;
    options.argument("DIR", folder_, not_empty, "folder of a plan, written by explore or sweep with --plan");
    options.number("--only", only_, {1, max_designs},
                   "Run the design with this number as far as it goes without the results of others");
    options.flag("--collect", only_collects_,
                 "Only write page and tables from the results that are there, and say what is missing");
    work_.declare(options);
  }

  int run() override {
    Signals signals;
    if (only_ && only_collects_) {
      print_err("wheelwright {}: give either --only or --collect\n", name());
      return exit_usage;
    }
    auto plan = read_plan(folder_);
    if (!plan) {
      print_err("wheelwright {}: {}\n", name(), plan.failure().text);
      return exit_usage;
    }
    const auto n = static_cast<int>(plan->designs.size());
    if (only_.value_or(1) > n) {
      print_err("wheelwright {}: --only {}: there are {} designs in {}\n", name(), *only_, n, folder_);
      return exit_usage;
    }
    const std::string chosen = only_ ? plan->designs[*only_ - 1].name : "";
    DesignSession session(folder_, *std::move(plan), work_, signals, watch_);
    if (only_collects_) return session.collect();
    warn_of_local_locks(folder_);
    return only_ ? session.run_only(chosen) : session.run();
  }

 private:
  std::string folder_;
  std::optional<int> only_;
  bool only_collects_ = false;
  WorkOptions work_;
  Stopwatch watch_;
};

}  // namespace

std::unique_ptr<Subcommand> make_designs() { return std::make_unique<DesignsCommand>(); }

}  // namespace wheelwright
