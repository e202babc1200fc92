#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "module.h"
#include "wheelwright/base/available_memory.h"
#include "wheelwright/base/parallel.h"
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

/// Writes tables, picture and page of the results that are there; returns the content of NAME.json.
std::string collect(const std::string& folder, const DesignPlan& plan) {
  return without_gil([&] {
    return designs_json(write_designs(folder, plan, standing(folder, plan).designs), plan.quantities);
  });
}

DesignPlan exploration(const HeldCase& held, int starts, std::uint64_t seed, bool keeps_sectors,
                       const std::vector<std::string>& words) {
  const auto quantities = chosen(held.value, words);
  return {.name = "exploration",
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

}  // namespace

void bind_designs(py::module_& m) {
  py::class_<DesignPlan>(m, "DesignPlan");
  m.def("exploration", &exploration);
  m.def("swept", &swept);
  m.def("plan_in", &plan_in);
  m.def("write_plan", &write_new_plan);
  m.def("run_plan", &run_plan);
  m.def("collect", &collect);
}

}  // namespace wheelwright::python
