#include <pybind11/stl.h>

#include <algorithm>
#include <set>

#include "computed.h"
#include "held_case.h"
#include "module.h"
#include "wheelwright/base/available_memory.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/design/explore/costs.h"
#include "wheelwright/design/explore/exploration.h"
#include "wheelwright/design/explore/sweep.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/run/results/run_title.h"

namespace wheelwright::python {
namespace {

std::vector<RankedQuantity> chosen(const Case& c, const std::vector<std::string>& words) {
  const auto known = ranked_quantities(c);
  std::vector<RankedQuantity> result;
  for (const std::string& word : words) {
    const auto found =
        std::ranges::find_if(known, [&](const auto& quantity) { return quantity.is_called(word); });
    if (found == known.end()) {
      std::string text;
      for (const RankedQuantity& quantity : known) text += (text.empty() ? "" : ", ") + quantity.word;
      throw py::value_error(word + " is none of " + text);
    }
    result.push_back(*found);
  }
  return result;
}

/// Runs the designs of a plan in its folder, with other processes if there are some. Ctrl-C stops the runs,
/// which are saved.
void run_plan(const std::string& folder, const DesignPlan& plan, int threads) {
  Signals signals;
  {
    const Computing computing;
    if (plan.designs.empty()) return;
    const int at_once = designs_at_once(static_cast<int>(plan.designs.size()), threads,
                                        design_costs(plan.designs).bytes, available_memory());
    const ThreadLimit limit(limit_of_threads(threads, at_once));
    RunSettings settings;
    settings.threads = at_once;
    settings.stop_requested = [&signals] { return signals.raised(); };
    settings.waits = [](const Design&, const FolderInUse&) { return true; };
    run_planned(folder, plan, settings);
  }
  signals.rethrow();
}

constexpr std::pair<Progression, const char*> progression_names[] = {{Progression::preview, "preview"},
                                                                     {Progression::full, "full"}};

std::string name_of(Progression progression) {
  return std::ranges::find(progression_names, progression, &std::pair<Progression, const char*>::first)
      ->second;
}

Progression progression_called(const std::string& name) {
  for (const auto& [progression, called] : progression_names)
    if (name == called) return progression;
  throw py::value_error("no progression " + name);
}

const Design& design_called(const DesignPlan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan.designs, name, &Design::name);
  if (found == plan.designs.end()) throw py::value_error("no design " + name + " in the plan");
  return *found;
}

/// The designs that are run next according to the results in the folder, and how far; without those that are
/// given up.
std::pair<std::string, std::vector<std::string>> due(
    const std::string& folder, const DesignPlan& plan,
    const std::set<std::pair<std::string, std::string>>& given_up) {
  return without_gil([&] {
    const Standing now = standing(folder, plan, [&](const Design& design, Progression progression) {
      return given_up.contains({design.name, name_of(progression)});
    });
    std::vector<std::string> names;
    for (const Design& one : now.due) names.push_back(one.name);
    return std::pair(name_of(now.progression), names);
  });
}

/// Runs one design on so many threads until its result is there, or to the first accepted shape after
/// `seconds`, where it is saved. Returns whether it is over, and its newest shape, if it has accepted one.
std::pair<bool, std::optional<int>> run_piece(const std::string& folder, const DesignPlan& plan,
                                              const std::string& name, const std::string& progression,
                                              double seconds, int threads) {
  Signals signals;
  const Design& design = design_called(plan, name);
  bool pauses = false;
  std::optional<int> newest;
  const Progression wanted = progression_called(progression);
  {
    const Computing computing;
    const ThreadLimit limit(threads);
    const Stopwatch watch;
    RunSettings settings;
    settings.stop_requested = [&signals] { return signals.raised(); };
    settings.pauses = [&](const Design&, int shape) {
      newest = shape;
      if (watch.seconds() < seconds) return false;
      return pauses = true;
    };
    run_designs(folder, {design}, wanted, settings);
  }
  signals.rethrow();
  return {!pauses || known_result(folder, design, wanted), newest};
}

/// Writes tables, picture and page of the results that are there; returns the content of NAME.json.
std::string collect(const std::string& folder, const DesignPlan& plan) {
  return without_gil([&] {
    return designs_json(write_designs(folder, plan, standing(folder, plan).designs), plan.quantities);
  });
}

DesignPlan exploration(const HeldCase& held, int starts, std::uint64_t seed, bool keeps_sectors,
                       const std::vector<std::string>& words) {
  const auto quantities = chosen(held.value, words);
  return {.name = "explore",
          .title = run_title(held.value),
          .has_previews = true,
          .quantities = quantities,
          .designs = computed([&](const Interrupt& interrupt) {
            return planned_designs(held.value, {starts, seed, keeps_sectors, quantities},
                                   {.must_end = [&] { return interrupt.requested(); }});
          })};
}

DesignPlan swept(const HeldCase& held, const std::vector<std::pair<std::string, std::vector<double>>>& keys,
                 const std::vector<std::string>& words) {
  std::vector<SweptKey> swept;
  for (const auto& [key, values] : keys) swept.push_back({key, values});
  auto designs = sweep_designs(held.value, held.given_cells, held.file, swept);
  if (!designs) throw py::value_error(designs.failure().text);
  return {.name = "sweep",
          .title = run_title(held.value),
          .quantities = chosen(held.value, words),
          .designs = *std::move(designs)};
}

/// The plan that another process wrote to the folder.
DesignPlan plan_in(const std::string& folder) {
  auto plan = read_plan(folder);
  if (!plan) throw py::value_error(plan.failure().text);
  return *std::move(plan);
}

/// Makes the folder, with the plan in it for other processes.
void write_new_plan(const std::string& folder, const DesignPlan& plan) {
  without_gil([&] {
    make_folder(folder);
    write_plan(folder, plan);
    return 0;
  });
}

/// The right to work on a design, while the object lives.
FileLock lock_design(const std::string& folder, const DesignPlan& plan, const std::string& name) {
  auto lock = FileLock::acquire(lock_of_design(folder, design_called(plan, name)));
  if (!lock) raise("RunError", "folder_in_use", to_string(lock.failure()) + " is running design " + name);
  return *std::move(lock);
}

}  // namespace

void bind_designs(py::module_& m) {
  py::class_<DesignPlan>(m, "DesignPlan");
  m.def("exploration", &exploration);
  m.def("swept", &swept);
  m.def("plan_in", &plan_in);
  m.def("write_plan", &write_new_plan);
  m.def("run_plan", &run_plan);
  m.def("due", &due);
  m.def("run_piece", &run_piece);
  m.def("collect", &collect);
  py::class_<FileLock>(m, "DesignLock");
  m.def("lock_design", &lock_design);
}

}  // namespace wheelwright::python
