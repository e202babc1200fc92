#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/design/explore/plan.h"
#include "wheelwright/design/explore/report_designs.h"
#include "wheelwright/design/starts/start.h"

namespace wheelwright {

/// The designs that an exploration tries.
struct ExplorationSettings {
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

/// The designs that an exploration tries: the same for the same case and settings; only the first ones if
/// generation had to stop. There are fewer than planned if all kinds of starts fail in turn. Fails if the
/// case's own shape cannot be solved, with empty_shape if the case defines no volume for its designs or no
/// start was found, and with unsupported_model for a turned wheel.
Expected<std::vector<Design>> planned_designs(const Case& c, const ExplorationSettings& wanted,
                                              const DrawingSettings& settings = {});

/// How many of so many previewed designs are chosen to be optimized to the end: about a third.
int number_of_chosen(int n_previews);

/// Which of the previewed designs are optimized to the end, in spread_order().
std::vector<int> chosen_designs(const std::vector<RatedDesign>& previews,
                                const std::vector<RankedQuantity>& quantities);

/// How far the designs of a folder are.
struct Standing {
  std::vector<RatedDesign> designs;  ///< those with results
  Progression progression;           ///< to which the next ones are run
  /// The designs that are run next, in any order and by any processes. Which designs follow depends on all
  /// their results. If there are none, all designs are done.
  std::vector<Design> due;
};

/// Whether the run of a design is given up, so that the choices are made without its result.
using IsGivenUp = std::function<bool(const Design&, Progression)>;

/// Standing according to the results in a folder. With previews: of all designs, then to the end about a
/// third chosen by their previews, then those that no other design beats. Otherwise: all to the end. Depends
/// only on the results, not on the order in which they were computed.
Standing standing(
    const std::filesystem::path& folder, const DesignPlan& plan,
    const IsGivenUp& is_given_up = [](const Design&, Progression) { return false; });

/// Runs what is due until nothing is, and returns all designs with their results. What cannot be run is given
/// up. Stops when the settings request it. Throws OutputError.
std::vector<RatedDesign> run_planned(const std::filesystem::path& folder, const DesignPlan& plan,
                                     const RunSettings& settings);

/// Names that write_designs() uses in a folder, besides NAME.csv, NAME.json and NAME.html.
inline constexpr const char* pareto_picture = "pareto.svg";

/// Ranks the designs and writes NAME.csv, NAME.json, NAME.html and pareto.svg. Throws OutputError.
std::vector<RankedDesign> write_designs(const std::filesystem::path& folder, const DesignPlan& plan,
                                        const std::vector<RatedDesign>& designs);

}  // namespace wheelwright
