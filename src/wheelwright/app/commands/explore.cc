#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/design_folder.h"
#include "wheelwright/app/design_session.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/lock_warning.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/write.h"
#include "wheelwright/design/explore/costs.h"
#include "wheelwright/run/results/run_title.h"

namespace wheelwright {
namespace {

class ExploreCommand : public Subcommand {
 public:
  ExploreCommand() : Subcommand("explore", "Optimize a case from many starts, and show the best designs") {}

  void declare(Options& options) override {
    constexpr int max_starts = 999, max_seed = 1'000'000'000;
    add_case(options, case_file_);
    options.number("--starts", wanted_.starts, {1, max_starts},
                   "Number of initial shapes: the case's own and generated ones, all of the same volume");
    options.number("--seed", seed_, {0, max_seed}, "Seed of the random numbers that generate them");
    options.flag("--keep-sectors", wanted_.keeps_sectors,
                 "Generate only numbers of holes that are multiples of wheel.sectors");
    plan_.declare(options);
    work_.declare(options);
  }

  int run() override {
    Signals signals;
    const auto c = read_or_report(case_file_);
    if (!c) return exit_usage;
    if (!may_compute(name(), *c, case_file_, work_.threads)) return exit_refused;
    const auto quantities = plan_.chosen_quantities(*c);
    if (!quantities) {
      print_err("wheelwright {}: --for: {}\n", name(), quantities.failure());
      return exit_usage;
    }
    wanted_.seed = static_cast<std::uint64_t>(seed_);
    wanted_.quantities = *quantities;
    const DesignFolder place{name(), plan_.folder_for(*c, "-explore"), settings(*c)};
    if (!place.may_be_used()) return exit_refused;
    warn_of_local_locks(place.folder);
    auto plan = place.known_plan(*quantities);
    if (!plan) {
      auto planned = place.planned([&] { return new_plan(*c, signals); });
      if (!planned) return planned.failure();
      plan = *std::move(planned);
    }
    DesignSession session(place.folder, *std::move(plan), work_, signals, watch_);
    return plan_.only_plans ? session.show_plan() : session.run();
  }

 private:
  Expected<DesignPlan, int> new_plan(const Case& c, const Signals& signals) const {
    const auto must_end = [&] {
      return signals.stop() || (work_.seconds && watch_.seconds() >= *work_.seconds);
    };
    auto designs = planned_designs(c, wanted_, drawing_settings(wanted_.starts, must_end));
    if (signals.stop()) {
      print_err("stopped while starts were being generated; nothing was saved\n");
      return exit_nothing_saved;
    }
    if (!designs) return report_failure(name(), designs.failure());
    const bool solves_finalists = c.output.errors == ErrorEstimates::estimated && !why_no_finalists(*designs);
    return DesignPlan{.name = name(),
                      .title = run_title(c),
                      .has_previews = true,
                      .solves_finalists = solves_finalists,
                      .is_complete = !must_end(),
                      .quantities = wanted_.quantities,
                      .designs = *std::move(designs)};
  }

  std::string settings(const Case& c) const {
    std::string text = fmt::format("starts {}\nseed {}\nkeep sectors {}\nfor", wanted_.starts, wanted_.seed,
                                   wanted_.keeps_sectors);
    for (const RankedQuantity& quantity : wanted_.quantities) text += fmt::format(" {}", quantity.word);
    return text + "\n\n" + to_toml(c);
  }

  std::string case_file_;
  ExplorationSettings wanted_;
  int seed_ = 1;
  PlanOptions plan_;
  WorkOptions work_;
  Stopwatch watch_;
};

}  // namespace

std::unique_ptr<Subcommand> make_explore() { return std::make_unique<ExploreCommand>(); }

}  // namespace wheelwright
