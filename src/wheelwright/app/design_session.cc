#include "wheelwright/app/design_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "wheelwright/app/costs_text.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/available_memory.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/design/explore/costs.h"
#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/run/results/stop_text.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr int printed_rows = 12;

/// Waits for other processes that collect.
std::optional<FolderLock> lock_to_collect(const fs::path& folder, const Signals& signals) {
  while (!signals.stop()) {
    if (auto lock = FolderLock::acquire(folder)) return *std::move(lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return {};
}

/// Waits for designs that others run; tells so once for each.
std::function<bool(const Design&, const FolderInUse&)> waiting() {
  // Asked for the first time, there may be other designs to run in the meantime.
  return [n_asked = std::map<std::string, int>(), mutex = std::make_shared<std::mutex>()](
             const Design& design, const FolderInUse& holder) mutable {
    const std::scoped_lock lock(*mutex);
    if (++n_asked[design.name] == 2)
      print_err("{} {}: {} is running it; waiting for its result\n", design.name, design.text,
                to_string(holder));
    return true;
  };
}

/// The names of designs, not all if they are many.
std::string names(const std::vector<Design>& designs) {
  constexpr std::size_t max_shown = 20;
  std::vector<std::string_view> shown;
  for (const Design& one : designs)
    if (shown.size() < max_shown) shown.push_back(one.name);
  return fmt::format(
      "{}{}", fmt::join(shown, ", "),
      designs.size() > max_shown ? fmt::format(" and {} more", designs.size() - max_shown) : "");
}

}  // namespace

void WorkOptions::declare(Options& options) {
  constexpr int max_seconds = 10'000'000;
  options.number("--seconds", seconds, {1, max_seconds},
                 "Start no further design after this time; default: no limit");
  options.flag("--without-errors", without_errors,
               "Do not solve the finalists on a finer grid, whose numbers rank them, with errors");
  add_threads(options, threads);
}

int WorkOptions::n_threads() const {
  return threads.value_or(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

DesignSession::DesignSession(fs::path folder, DesignPlan plan, const WorkOptions& options,
                             const Signals& signals, const Stopwatch& watch)
    : folder_(std::move(folder)),
      plan_(std::move(plan)),
      options_(options),
      signals_(signals),
      watch_(watch) {}

bool DesignSession::is_time_over() const { return options_.seconds && watch_.seconds() >= *options_.seconds; }

bool DesignSession::has_finalists() const { return plan_.solves_finalists && !options_.without_errors; }

int DesignSession::at_once(double bytes) const {
  return designs_at_once(static_cast<int>(plan_.designs.size()), options_.n_threads(), bytes,
                         available_memory());
}

RunSettings DesignSession::run_settings(int at_once) {
  RunSettings settings;
  settings.threads = at_once;
  settings.stop_requested = [this] { return signals_.stop().has_value(); };
  settings.may_begin = [this] { return !is_time_over(); };
  settings.done = [this](const Design& design, const DesignResult& result) { show(design, result); };
  settings.left_out = [](const Design& design, const std::string& why) {
    print_err("{} {}: left out: {}\n", design.name, design.text, why);
  };
  return settings;
}

FinalistSettings DesignSession::finalist_settings(int at_once) {
  FinalistSettings settings;
  settings.threads = at_once;
  settings.stop_requested = [this] { return signals_.stop().has_value(); };
  settings.begin = [](const std::vector<RatedDesign>& designs, double seconds) {
    print_err("solving {} on a finer grid, which takes about {:.0f} s\n",
              designs.size() == 1 ? "1 finalist" : fmt::format("{} finalists", designs.size()),
              std::ceil(seconds));
  };
  settings.done = [this](const RatedDesign& finalist) { show_finalist(finalist); };
  return settings;
}

void DesignSession::show_finalist(const RatedDesign& finalist) const {
  std::string numbers;
  for (const RankedQuantity& quantity : plan_.quantities)
    if (const auto error = finalist.error(quantity.key))
      numbers += fmt::format(", {} {} {}", quantity.word,
                             text_with_error(finalist.value(quantity.key) * quantity.shown.factor,
                                             *error * quantity.shown.factor),
                             quantity.shown.name);
  print_err("{} {}: {}{}\n", finalist.design.name, finalist.design.text,
            finalist.finer->failure.empty() ? finalist.finer->grid : finalist.finer->failure, numbers);
}

void DesignSession::show(const Design& design, const DesignResult& result) const {
  std::string numbers;
  for (const RankedQuantity& quantity : plan_.quantities)
    if (!result.numbers.empty())
      numbers += fmt::format(", {} {:.5g} {}", quantity.word, result.value(quantity) * quantity.shown.factor,
                             quantity.shown.name);
  print_err("{} {}: {} shapes, {}{}\n", design.name, design.text, result.shapes, text_of_stop(result.status),
            numbers);
}

int DesignSession::show_plan() const {
  print_lines(stdout, costs_text(plan_, options_.n_threads(), !options_.without_errors));
  print("{} designs are planned in {}\n", plan_.designs.size(), folder_.string());
  for (const auto& [call, meaning] : {std::pair{"", "runs all that are left, and collects the results"},
                                      {" --only 1", "runs one of them, as far as it goes"},
                                      {" --collect", "collects the results that are there"}})
    print("  wheelwright designs {}{:<10}  {}\n", folder_.string(), call, meaning);
  return exit_done;
}

std::vector<RatedDesign> DesignSession::run_all() {
  const int at_once = this->at_once(design_costs(plan_.designs).bytes);
  const ThreadLimit limit(limit_of_threads(options_.n_threads(), at_once));
  RunSettings settings = run_settings(at_once);
  settings.waits = waiting();
  return run_planned(folder_, plan_, settings);
}

std::vector<RatedDesign> DesignSession::solve_finalists(const std::vector<RatedDesign>& designs) {
  const int at_once = this->at_once(design_costs(plan_.designs).bytes_on_finer_grid);
  const ThreadLimit limit(limit_of_threads(options_.n_threads(), at_once));
  FinalistSettings settings = finalist_settings(at_once);
  settings.waits = waiting();
  return with_finer_numbers(folder_, designs, plan_.quantities, settings);
}

int DesignSession::run() {
  if (plan_.designs.empty()) return write({});
  if (!standing(folder_, plan_).due.empty())
    print_lines(stderr, costs_text(plan_, options_.n_threads(), !options_.without_errors));
  std::vector<RatedDesign> designs = run_all();
  if (has_finalists() && !signals_.stop()) designs = solve_finalists(designs);
  if (const auto signal = signals_.stop()) return end_of_stopped(128 + *signal);
  return write(designs);
}

int DesignSession::run_only(const std::string& name) {
  const ThreadLimit all_threads(options_.n_threads());
  bool is_left_out = false;
  RunSettings settings = run_settings(1);
  settings.left_out = [&, report = settings.left_out](const Design& design, const std::string& why) {
    is_left_out = true;
    report(design, why);
  };
  for (int n_done = 0; !is_left_out && !signals_.stop() && !is_time_over(); ++n_done) {
    if (run_next_step(name, settings)) continue;
    if (n_done == 0) print_err("{}: nothing is due for it now\n", name);
    return exit_done;
  }
  if (const auto signal = signals_.stop()) return end_of_stopped(128 + *signal);
  return is_left_out ? exit_refused : exit_done;
}

bool DesignSession::run_next_step(const std::string& name, const RunSettings& settings) {
  const Standing now = standing(folder_, plan_);
  const auto due = std::ranges::find(now.due, name, &Design::name);
  if (due != now.due.end()) {
    run_designs(folder_, {*due}, now.progression, settings);
    return true;
  }
  if (!now.due.empty() || !has_finalists()) return false;
  const auto finalists = standing_of_finalists(folder_, now.designs, plan_.quantities);
  for (const int i : finalists.due) {
    const RatedDesign& one = finalists.designs[i];
    if (one.design.name != name) continue;
    return solve_on_finer_grid(folder_, {one}, finalist_settings(1)).empty();
  }
  return false;
}

int DesignSession::collect() {
  const Standing now = standing(folder_, plan_);
  std::vector<RatedDesign> designs = now.designs;
  if (!now.due.empty()) {
    print_err("{} of {} designs have not ended: {}{}\n", now.due.size(), plan_.designs.size(), names(now.due),
              now.progression == Progression::preview
                  ? "; some are optimized to the end when all previews are there"
                  : "");
  } else if (has_finalists()) {
    StandingOfFinalists finalists = standing_of_finalists(folder_, designs, plan_.quantities);
    if (!finalists.due.empty())
      print_err("{} finalists are not solved on a finer grid yet\n", finalists.due.size());
    designs = std::move(finalists.designs);
  }
  return write(designs);
}

int DesignSession::write(const std::vector<RatedDesign>& designs) {
  const auto lock = lock_to_collect(folder_, signals_);
  if (!lock) return end_of_stopped(128 + *signals_.stop());
  const auto order = write_designs(folder_, plan_, designs);
  print_results(order);
  if (std::ranges::any_of(order, [](const RankedDesign& one) { return one.front > 0; })) return exit_done;
  const bool any_result =
      std::ranges::any_of(order, [](const RankedDesign& one) { return !one.result.numbers.empty(); });
  return any_result ? exit_infeasible : exit_no_solution;
}

int DesignSession::end_of_stopped(int code) const {
  print_err("stopped and saved; to continue, give the same command again\n");
  return code;
}

void DesignSession::print_results(const std::vector<RankedDesign>& order) const {
  print_lines(stdout, designs_table(order, plan_.quantities, printed_rows));
  print("\n{} designs, *: no other design is better in all quantities\n", order.size());
  const auto n_finer = std::ranges::count_if(
      order, [](const RankedDesign& one) { return one.finer && one.finer->failure.empty(); });
  if (n_finer > 0) print("numbers with an error (+-) are those of a finer grid, of {} finalists\n", n_finer);
  for (const UndecidedDesigns& undecided : undecided_designs(order, plan_.quantities))
    print("{}\n", text(undecided));
  for (const auto& [file, meaning] : {std::pair{plan_.name + ".html", "all designs, for a browser"},
                                      {std::string(pareto_picture), "the picture"},
                                      {plan_.name + ".csv", "the numbers, also as .json"},
                                      {std::string(folder_of_designs), "one run per design"}})
    print("  {:<36} {}\n", (folder_ / file).string(), meaning);
}

}  // namespace wheelwright
