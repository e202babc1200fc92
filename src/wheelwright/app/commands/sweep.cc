#include "wheelwright/design/explore/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/design_folder.h"
#include "wheelwright/app/design_session.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/lock_warning.h"
#include "wheelwright/app/number_list.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/design/explore/costs.h"
#include "wheelwright/run/results/run_title.h"

namespace wheelwright {
namespace {

constexpr const char* form =
    "KEY=A,B,... | KEY=FROM:TO:NUMBER | KEY=FROM:TO:NUMBER:log, followed by a space and a unit if it is not "
    "that of the case file";

std::optional<SweptKey> parse_swept_key(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return {};
  const std::size_t end = std::min(text.find(' ', equals), text.size());
  auto values = parse_number_list(std::string_view(text).substr(equals + 1, end - equals - 1));
  if (!values) return {};
  return SweptKey{text.substr(0, equals), *std::move(values), text.substr(std::min(end + 1, text.size()))};
}

class SweepCommand : public Subcommand {
 public:
  SweepCommand() : Subcommand("sweep", "Optimize a case for all combinations of some keys' values") {}

  void declare(Options& options) override {
    add_case(options, case_file_);
    options.arguments("KEYS", texts_, 1,
                      fmt::format("Keys of the case with their values, e.g. load.mass=100:300:5 or "
                                  "'constraint[1].at_least=6000,7000 "
                                  "N/mm'; each is {}",
                                  form));
    plan_.declare(options);
    work_.declare(options);
  }

  int run() override {
    Signals signals;
    std::vector<SweptKey> keys;
    for (const std::string& text : texts_) {
      auto key = parse_swept_key(text);
      if (!key) {
        print_err("wheelwright {}: {}: must be {}\n", name(), text, form);
        return exit_usage;
      }
      keys.push_back(*std::move(key));
    }
    const auto c = read_or_report(case_file_);
    if (!c) return exit_usage;
    auto designs = sweep_designs(*c, read_case(case_file_).given_cells, case_file_, keys);
    if (!designs) {
      print_err("wheelwright {}: {}\n", name(), designs.failure().text);
      return exit_usage;
    }
    if (!may_compute(name(), *c, case_file_, work_.threads)) return exit_refused;
    return run_designs(*c, *std::move(designs), signals);
  }

 private:
  int run_designs(const Case& c, std::vector<Design> designs, const Signals& signals) const {
    const auto quantities = plan_.chosen_quantities(c);
    if (!quantities) {
      print_err("wheelwright {}: --for: {}\n", name(), quantities.failure());
      return exit_usage;
    }
    const DesignFolder place{name(), plan_.folder_for(c, "-sweep"),
                             fmt::format("{}\n\n", fmt::join(texts_, "\n")) + to_toml(c)};
    if (!place.may_be_used()) return exit_refused;
    warn_of_local_locks(place.folder);
    auto plan = place.known_plan(*quantities);
    if (!plan) {
      auto planned = place.planned([&]() -> Expected<DesignPlan, int> {
        const bool solves_finalists =
            c.output.errors == ErrorEstimates::estimated && !why_no_finalists(designs);
        return DesignPlan{.name = name(),
                          .title = run_title(c),
                          .solves_finalists = solves_finalists,
                          .quantities = *quantities,
                          .designs = std::move(designs)};
      });
      if (!planned) return planned.failure();
      plan = *std::move(planned);
    }
    DesignSession session(place.folder, *std::move(plan), work_, signals, watch_);
    return plan_.only_plans ? session.show_plan() : session.run();
  }

  std::string case_file_;
  std::vector<std::string> texts_;
  PlanOptions plan_;
  WorkOptions work_;
  Stopwatch watch_;
};

}  // namespace

std::unique_ptr<Subcommand> make_sweep() { return std::make_unique<SweepCommand>(); }

}  // namespace wheelwright
