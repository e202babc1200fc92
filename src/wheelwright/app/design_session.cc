#include "wheelwright/app/design_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/files/written_files.h"
#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/run/results/stop_text.h"
#include "wheelwright/run/study/problem_size.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr const char* settings_file = "settings.txt";
constexpr int printed_rows = 12;

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// The part of a word before " of ", which names a quantity of a layer.
std::string_view quantity_in(std::string_view word) { return word.substr(0, word.find(" of ")); }

std::string check_quantities(const std::string& text) {
  std::vector<std::string_view> known;
  for (const RankedQuantity& quantity : ranked_quantities()) known.push_back(quantity.word);
  for (const std::string& word : words(text))
    if (!find_quantity(quantity_in(word)))
      return fmt::format("'{}' is none of {}", word, fmt::join(known, ", "));
  return "";
}

/// Why designs of a case are not ranked by a word that may be one of others.
std::string fault_of_word(const Case& c, const std::string& word, const std::vector<RankedQuantity>& known) {
  const auto needs = unmet_needs_of_ranked(c, quantity_in(word));
  if (!needs.empty()) return fmt::format("{}; set {}", needs.front().problem, needs.front().key.path());
  std::vector<std::string_view> words;
  for (const RankedQuantity& quantity : known) words.push_back(quantity.word);
  return fmt::format("'{}' is none of {}", word, fmt::join(words, ", "));
}

/// The ranked quantity that corresponds to the minimized one.
const RankedQuantity* ranked_as_minimized(const Case& c, const std::vector<RankedQuantity>& known) {
  Quantity minimized = minimized_quantity(c);
  if (minimized == built_in("peak_von_mises_inside")) minimized = built_in("peak_von_mises");
  const auto found = std::ranges::find(known, number_key(minimized, 2), &RankedQuantity::key);
  return found == known.end() ? nullptr : &*found;
}

}  // namespace

void DesignOptions::declare(Options& options) {
  add_output(options, output, "Folder for the results, instead of the case's output.folder with a suffix");
  std::vector<std::string> known;
  for (const RankedQuantity& quantity : ranked_quantities())
    known.push_back(fmt::format("{} [{}]", quantity.word, quantity.shown.name));
  options.text("--for", "QUANTITY,...", quantities, check_quantities,
               fmt::format("Quantities by which designs are ranked and plotted; default: what the case "
                           "minimizes, or stiffness, and run_out; known: {}",
                           fmt::join(known, ", ")));
  constexpr int max_seconds = 10'000'000;
  options.number("--seconds", seconds, {1, max_seconds},
                 "Start no further design after this time; default: no limit");
  options.flag("--without-errors", without_errors,
               "Do not solve the finalists on a finer grid, whose numbers rank them, with errors");
  add_threads(options, threads);
}

Expected<std::vector<RankedQuantity>, std::string> DesignOptions::chosen_quantities(const Case& c) const {
  const std::vector<RankedQuantity> known = ranked_quantities(c);
  const auto of_word = [&](std::string_view word) {
    return std::ranges::find(known, word, &RankedQuantity::word);
  };
  std::vector<RankedQuantity> chosen;
  if (quantities) {
    for (const std::string& word : words(*quantities)) {
      const auto found = of_word(word);
      if (found == known.end()) return fault_of_word(c, word, known);
      chosen.push_back(*found);
    }
    return chosen;
  }
  const RankedQuantity* minimized = ranked_as_minimized(c, known);
  chosen.push_back(minimized ? *minimized : *of_word("stiffness"));
  const std::string_view evenness = c.load.travel ? "force_variation" : "run_out";
  if (chosen.front().word != evenness) chosen.push_back(*of_word(evenness));
  return chosen;
}

int DesignOptions::n_threads() const {
  return threads.value_or(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

DesignSession::DesignSession(std::string name, fs::path folder, const DesignOptions& options, const Case& c,
                             const Signals& signals, std::vector<RankedQuantity> quantities,
                             std::string settings)
    : name_(std::move(name)),
      folder_(std::move(folder)),
      options_(options),
      case_(c),
      signals_(signals),
      settings_(std::move(settings)),
      quantities_(std::move(quantities)) {}

bool DesignSession::may_begin() {
  const std::string csv = name_ + ".csv", json = name_ + ".json", html = name_ + ".html";
  const std::string_view names[] = {csv,      json, html, pareto_picture, settings_file, folder_of_designs,
                                    lock_file};
  const auto foreign = WrittenFiles(folder_).foreign(names);
  if (!foreign.empty()) {
    print_err(
        "{}: {}: already exists, and was not written by this program; choose another folder with --output\n",
        folder_.string(), fmt::format("{}", fmt::join(foreign, ", ")));
    return false;
  }
  auto lock = FolderLock::acquire(folder_);
  if (!lock) {
    print_err("{}: {} is writing to this folder; wait for it, or choose another folder with --output\n",
              folder_.string(), to_string(lock.failure()));
    return false;
  }
  if (is_there(folder_ / settings_file) && file_content(folder_ / settings_file) != settings_) {
    print_err(
        "{}: contains designs of another case or of other options, according to its {}; choose another "
        "folder with "
        "--output, or remove this one\n",
        folder_.string(), settings_file);
    return false;
  }
  lock_.emplace(*std::move(lock));
  write_atomically(folder_ / settings_file, settings_);
  return true;
}

bool DesignSession::is_time_over() const { return options_.seconds && watch_.seconds() >= *options_.seconds; }

DrawingSettings DesignSession::drawing_settings(int n_starts) const {
  constexpr double seconds_between = 2;
  DrawingSettings settings;
  settings.must_end = [this] { return signals_.stop() || is_time_over(); };
  settings.report = [n_starts, last = Stopwatch()](const DrawingProgress& progress) mutable {
    const bool is_complete = progress.n_starts == n_starts;
    if (progress.has_ended ? is_complete : last.seconds() < seconds_between) return;
    last.lap();
    const std::string failed = to_string(progress.failed);
    print_err("starts generated: {} of {}{}{}\n", progress.n_starts, n_starts, failed.empty() ? "" : "; ",
              failed);
  };
  return settings;
}

RunSettings DesignSession::run_settings(std::size_t n_designs) const {
  RunSettings settings;
  settings.threads = options_.n_threads();
  if (const auto available = available_memory())
    settings.threads =
        std::clamp(static_cast<int>(*available / estimated_memory(problem_size(case_))), 1, settings.threads);
  settings.stop_requested = [this] { return signals_.stop().has_value(); };
  settings.may_begin = [this] { return !is_time_over(); };
  settings.done = [this, n_designs, n_done = 0](const Design& design, const DesignResult& result) mutable {
    print_err("{:>3}/{}  ", ++n_done, n_designs);
    show(design, result);
  };
  settings.left_out = [](const Design& design, const std::string& why) {
    print_err("{} {}: left out: {}\n", design.name, design.text, why);
  };
  return settings;
}

FinalistSettings DesignSession::finalist_settings() const {
  FinalistSettings settings;
  settings.threads = options_.n_threads();
  if (const auto available = available_memory())
    settings.threads =
        std::clamp(static_cast<int>(*available / memory_on_finer_grid<2>(case_)), 1, settings.threads);
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
  for (const RankedQuantity& quantity : quantities_)
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
  for (const RankedQuantity& quantity : quantities_)
    if (!result.numbers.empty())
      numbers += fmt::format(", {} {:.5g} {}", quantity.word, result.value(quantity) * quantity.shown.factor,
                             quantity.shown.name);
  print_err("{} {}: {} shapes, {}{}\n", design.name, design.text, result.shapes, text_of_stop(result.status),
            numbers);
}

int DesignSession::run(std::size_t n_designs, const Work& work) const {
  const ThreadLimit one_thread_each(1);
  std::vector<RatedDesign> designs = work(run_settings(n_designs));
  if (const auto signal = signals_.stop()) return end_of_stopped(!designs.empty(), *signal);
  if (!options_.without_errors && case_.output.errors == ErrorEstimates::estimated)
    designs = with_finer_numbers(folder_, std::move(designs), quantities_, finalist_settings());
  if (const auto signal = signals_.stop()) return end_of_stopped(!designs.empty(), *signal);
  const auto order = write_designs(folder_, name_, designs, quantities_, run_title(case_));
  print_results(order);
  if (std::ranges::any_of(order, [](const RankedDesign& one) { return one.front > 0; })) return exit_done;
  const bool any_result =
      std::ranges::any_of(order, [](const RankedDesign& one) { return !one.result.numbers.empty(); });
  return any_result ? exit_infeasible : exit_no_solution;
}

int DesignSession::end_of_stopped(bool has_designs, int signal) const {
  print_err("stopped and saved; to continue, give the same command again\n");
  return has_designs ? 128 + signal : exit_nothing_saved;
}

void DesignSession::print_results(const std::vector<RankedDesign>& order) const {
  print_lines(stdout, designs_table(order, quantities_, printed_rows));
  print("\n{} designs, *: no other design is better in all quantities\n", order.size());
  const auto n_finer = std::ranges::count_if(
      order, [](const RankedDesign& one) { return one.finer && one.finer->failure.empty(); });
  if (n_finer > 0) print("numbers with an error (+-) are those of a finer grid, of {} finalists\n", n_finer);
  for (const UndecidedDesigns& undecided : undecided_designs(order, quantities_))
    print("{}\n", text(undecided));
  for (const auto& [file, meaning] : {std::pair{name_ + ".html", "all designs, for a browser"},
                                      {std::string(pareto_picture), "the picture"},
                                      {name_ + ".csv", "the numbers, also as .json"},
                                      {std::string(folder_of_designs), "one run per design"}})
    print("  {:<36} {}\n", (folder_ / file).string(), meaning);
}

bool is_plane_or_report(const std::string& command, const Case& c, const std::string& file) {
  if (c.wheel.dimension == 2) return true;
  print_err(
      "wheelwright {}: {}: this command tries many designs, each of which takes minutes to hours in 3D; set "
      "wheel.dimension = 2, and start a case in 3D from the best design, by [shape] from\n",
      command, file);
  return false;
}

fs::path folder_for(const DesignOptions& options, const Case& c, const std::string& ending) {
  return options.output ? fs::path(*options.output) : fs::path(c.output.folder + ending);
}

}  // namespace wheelwright
