#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/design_session.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

class ExploreCommand : public Subcommand {
 public:
  ExploreCommand() : Subcommand("explore", "Optimize a case from many starts, and show the best designs") {}

  void declare(Options& options) override {
    constexpr int max_starts = 999, max_seed = 1'000'000'000;
    add_case(options, case_file_);
    options.number("--starts", plan_.starts, {1, max_starts},
                   "Number of initial shapes: the case's own and generated ones, all of the same volume");
    options.number("--seed", seed_, {0, max_seed}, "Seed of the random numbers that generate them");
    options.flag("--keep-sectors", plan_.keeps_sectors,
                 "Generate only numbers of holes that are multiples of wheel.sectors");
    options_.declare(options);
  }

  int run() override {
    Signals signals;
    const auto c = read_or_report(case_file_);
    if (!c) return exit_usage;
    if (!is_plane_or_report(name(), *c, case_file_)) return exit_refused;
    if (!may_compute(name(), *c, case_file_, options_.threads)) return exit_refused;
    plan_.seed = static_cast<std::uint64_t>(seed_);
    const auto quantities = options_.chosen_quantities(*c);
    if (!quantities) {
      print_err("wheelwright {}: --for: {}\n", name(), quantities.failure());
      return exit_usage;
    }
    plan_.quantities = *quantities;
    const auto folder = folder_for(options_, *c, "-explore");
    DesignSession session(name(), folder, options_, *c, signals, *quantities, settings(*c));
    if (!session.may_begin()) return exit_refused;
    const auto designs = planned_designs(*c, plan_, session.drawing_settings(plan_.starts));
    if (const auto signal = signals.stop()) {
      print_err("stopped while starts were being generated; nothing was saved\n");
      return exit_nothing_saved;
    }
    if (!designs) return report_failure(name(), designs.failure());
    const std::size_t n_runs = designs->size() + (designs->size() + 2) / 3;
    return session.run(n_runs, [&](const RunSettings& settings) {
      return wheelwright::explore(folder, *designs, plan_.quantities, settings);
    });
  }

 private:
  std::string settings(const Case& c) const {
    std::string text = fmt::format("starts {}\nseed {}\nkeep sectors {}\nfor", plan_.starts, plan_.seed,
                                   plan_.keeps_sectors);
    for (const RankedQuantity& quantity : plan_.quantities) text += fmt::format(" {}", quantity.word);
    return text + "\n\n" + to_toml(c);
  }

  std::string case_file_;
  ExplorationPlan plan_;
  int seed_ = 1;
  DesignOptions options_;
};

}  // namespace

std::unique_ptr<Subcommand> make_explore() { return std::make_unique<ExploreCommand>(); }

}  // namespace wheelwright
