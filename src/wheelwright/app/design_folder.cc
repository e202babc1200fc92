#include "wheelwright/app/design_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/files/written_files.h"
#include "wheelwright/run/checkpoints/folder_lock.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr const char* settings_file = "settings.txt";

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
  const auto found = std::ranges::find(known, number_key(minimized, c.wheel.dimension), &RankedQuantity::key);
  return found == known.end() ? nullptr : &*found;
}

}  // namespace

void PlanOptions::declare(Options& options) {
  add_output(options, output, "Folder for the results, instead of the case's output.folder with a suffix");
  std::vector<std::string> known;
  for (const RankedQuantity& quantity : ranked_quantities())
    known.push_back(fmt::format("{} [{}]", quantity.word, quantity.shown.name));
  options.text("--for", "QUANTITY,...", quantities, check_quantities,
               fmt::format("Quantities by which designs are ranked and plotted; default: what the case "
                           "minimizes, or stiffness, and run_out; known: {}",
                           fmt::join(known, ", ")));
  options.flag("--plan", only_plans,
               "Only write the list of designs, with the case of each; `wheelwright designs` runs them");
}

Expected<std::vector<RankedQuantity>, std::string> PlanOptions::chosen_quantities(const Case& c) const {
  const std::vector<RankedQuantity> known = ranked_quantities(c);
  const auto of_word = [&](std::string_view word) {
    return std::ranges::find_if(known, [&](const auto& quantity) { return quantity.is_called(word); });
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
  // A body of revolution rolls evenly.
  const bool is_even = c.optimizer.made == Manufacture::turned;
  if (chosen.front().word != evenness && !is_even) chosen.push_back(*of_word(evenness));
  return chosen;
}

fs::path PlanOptions::folder_for(const Case& c, const std::string& ending) const {
  return output ? fs::path(*output) : fs::path(c.output.folder + ending);
}

bool DesignFolder::may_be_used() const {
  const std::string csv = command + ".csv", json = command + ".json", html = command + ".html";
  const std::string_view names[] = {csv,       json,          html,      pareto_picture,
                                    plan_file, settings_file, lock_file, folder_of_designs};
  const auto foreign = WrittenFiles(folder).foreign(names);
  if (!foreign.empty()) {
    print_err(
        "{}: {}: already exists, and was not written by this program; choose another folder with --output\n",
        folder.string(), fmt::format("{}", fmt::join(foreign, ", ")));
    return false;
  }
  if (is_there(folder / settings_file) && file_content(folder / settings_file) != settings) {
    print_err(
        "{}: contains designs of another case or of other options, according to its {}; choose another "
        "folder with "
        "--output, or remove this one\n",
        folder.string(), settings_file);
    return false;
  }
  return true;
}

std::optional<DesignPlan> DesignFolder::known_plan(const std::vector<RankedQuantity>& quantities) const {
  if (!is_there(folder / settings_file)) return {};
  auto plan = read_plan(folder);
  if (!plan || !plan->is_complete ||
      !std::ranges::equal(plan->quantities, quantities, {}, &RankedQuantity::word, &RankedQuantity::word))
    return {};
  return *std::move(plan);
}

Expected<DesignPlan, int> DesignFolder::planned(
    const std::function<Expected<DesignPlan, int>()>& plan) const {
  const auto lock = FolderLock::acquire(folder);
  if (!lock) {
    print_err("{}: {} is writing to this folder; wait for it, or choose another folder with --output\n",
              folder.string(), to_string(lock.failure()));
    return exit_refused;
  }
  write_atomically(folder / settings_file, settings);
  const auto designs = plan();
  if (!designs) return designs.failure();
  write_plan(folder, *designs);
  auto written = read_plan(folder);
  if (written) return *std::move(written);
  print_err("wheelwright {}: {}\n", command, written.failure().text);
  return exit_bug;
}

DrawingSettings drawing_settings(int n_starts, std::function<bool()> must_end) {
  constexpr double seconds_between = 2;
  DrawingSettings settings;
  settings.must_end = std::move(must_end);
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

}  // namespace wheelwright
