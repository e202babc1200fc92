#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "module.h"
#include "wheelwright/base/parallel.h"
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
    const auto found = std::ranges::find(known, word, &RankedQuantity::word);
    if (found == known.end()) {
      std::string text;
      for (const RankedQuantity& quantity : known) text += (text.empty() ? "" : ", ") + quantity.word;
      throw py::value_error(word + " is none of " + text);
    }
    result.push_back(*found);
  }
  return result;
}

/// NAME.json of the designs of a plan, which are run in its folder. A callback that raises, and Ctrl-C, stop
/// the runs, which are saved.
std::string ranked_designs(const std::string& folder, const DesignPlan& plan, int threads) {
  Signals signals;
  std::optional<std::vector<RatedDesign>> designs;
  {
    const Computing computing;
    const ThreadLimit one_thread_each(1);
    RunSettings settings;
    settings.threads = threads;
    settings.stop_requested = [&signals] { return signals.raised(); };
    settings.waits = [](const Design&, const FolderInUse&) { return true; };
    designs.emplace(run_planned(folder, plan, settings));
  }
  signals.rethrow();
  return without_gil([&] { return designs_json(write_designs(folder, plan, *designs), plan.quantities); });
}

std::string explored(const HeldCase& held, const std::string& folder, int starts, std::uint64_t seed,
                     bool keeps_sectors, const std::vector<std::string>& words, int threads) {
  const auto quantities = chosen(held.value, words);
  const auto designs = computed([&](const Interrupt& interrupt) {
    return planned_designs(held.value, {starts, seed, keeps_sectors, quantities},
                           {.must_end = [&] { return interrupt.requested(); }});
  });
  return ranked_designs(folder,
                        {.name = "exploration",
                         .title = run_title(held.value),
                         .has_previews = true,
                         .quantities = quantities,
                         .designs = designs},
                        threads);
}

std::string swept(const HeldCase& held, const std::string& folder,
                  const std::vector<std::pair<std::string, std::vector<double>>>& keys,
                  const std::vector<std::string>& words, int threads) {
  const auto quantities = chosen(held.value, words);
  std::vector<SweptKey> swept;
  for (const auto& [key, values] : keys) swept.push_back({key, values});
  const auto designs = sweep_designs(held.value, held.given_cells, held.file, swept);
  if (!designs) throw py::value_error(designs.failure().text);
  return ranked_designs(
      folder,
      {.name = "sweep", .title = run_title(held.value), .quantities = quantities, .designs = *designs},
      threads);
}

}  // namespace

void bind_designs(py::module_& m) {
  m.def("explore", &explored);
  m.def("sweep", &swept);
}

}  // namespace wheelwright::python
