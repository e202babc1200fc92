#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/design/explore/report_designs.h"
#include "wheelwright/design/starts/start.h"

namespace wheelwright {

/// The designs that an exploration tries.
struct ExplorationPlan {
  int starts = 60;  ///< the case's own shape, if it has one, and random ones
  std::uint64_t seed = 1;
  bool keeps_sectors = false;  ///< only numbers of holes that are multiples of the case's sectors
  std::vector<RankedQuantity> quantities;
};

/// The weights of J_p2 [-] that an exploration gives its designs if even rolling is requested, in units of
/// J_e / J_p2 of the case's own wheel, so that they do not depend on load, material or size.
inline constexpr double relative_weights_of_evenness[] = {0, 0.3, 3};

/// Progress in generating the starts of an exploration.
struct DrawingProgress {
  int n_starts;
  FailedAttempts failed;
  bool has_ended;
};

/// Callbacks while starts are generated, which takes seconds to minutes.
struct DrawingSettings {
  /// Called before every attempt: whether to stop with the starts found so far.
  std::function<bool()> must_end = [] { return false; };
  /// Called after every start, successful or not, and at the end.
  std::function<void(const DrawingProgress&)> report = [](const DrawingProgress&) {};
};

/// The designs that an exploration tries: the same for the same case and plan; only the first ones if
/// generation had to stop. There are fewer than planned if all kinds of starts fail in turn. Fails if the
/// case's own shape cannot be solved, and with empty_shape if the case defines no volume for its designs or
/// no start was found.
Expected<std::vector<Design>> planned_designs(const Case& c, const ExplorationPlan& plan,
                                              const DrawingSettings& settings = {});

/// Which of the previewed designs are optimized to the end: about a third of them, in spread_order().
std::vector<int> chosen_designs(const std::vector<RatedDesign>& previews,
                                const std::vector<RankedQuantity>& quantities);

/// Runs the designs: previews of all, then to the end about a third chosen by their previews, then those that
/// no other design beats. Returns all designs with their results. Stops when the settings request it. Throws
/// OutputError.
std::vector<RatedDesign> explore(const std::filesystem::path& folder, const std::vector<Design>& designs,
                                 const std::vector<RankedQuantity>& quantities, const RunSettings& settings);

/// All designs, run to the end. Throws OutputError.
std::vector<RatedDesign> run_all(const std::filesystem::path& folder, const std::vector<Design>& designs,
                                 const RunSettings& settings);

/// Names that write_designs() uses in a folder, besides NAME.csv, NAME.json and NAME.html.
inline constexpr const char* pareto_picture = "pareto.svg";

/// Ranks the designs and writes NAME.csv, NAME.json, NAME.html and pareto.svg. Throws OutputError.
std::vector<RankedDesign> write_designs(const std::filesystem::path& folder, const std::string& name,
                                        const std::vector<RatedDesign>& designs,
                                        const std::vector<RankedQuantity>& quantities,
                                        const std::string& title);

}  // namespace wheelwright
