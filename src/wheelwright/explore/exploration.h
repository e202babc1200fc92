#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/explore/design_runs.h"
#include "wheelwright/explore/report_designs.h"
#include "wheelwright/starts/start.h"

namespace wheelwright {

/// What an exploration tries.
struct ExplorationPlan {
  int starts = 60;  ///< the case's own shape, if it has one, and drawn ones
  std::uint64_t seed = 1;
  bool keeps_sectors = false;  ///< only numbers of holes that are multiples of the case's sectors
  std::vector<RankedQuantity> quantities;
};

/// The weights of J_p2 [-] that an exploration gives its designs where even rolling is asked for, in units of
/// the ratio of J_e and J_p2 of the case's own wheel: so they do not depend on load, material or size.
inline constexpr double relative_weights_of_evenness[] = {0, 0.3, 3};

/// How far the starts of an exploration are drawn.
struct DrawingProgress {
  int n_starts;
  FailedAttempts failed;
  bool has_ended;
};

/// Drawing starts takes seconds to minutes. This is asked and told meanwhile.
struct DrawingSettings {
  /// Asked before every attempt: whether the starts drawn so far must do.
  std::function<bool()> must_end = [] { return false; };
  /// Told after every start, drawn or not, and at the end.
  std::function<void(const DrawingProgress&)> told = [](const DrawingProgress&) {};
};

/// The designs that an exploration tries: the same for the same case and plan; the first ones of them if
/// drawing had to end. There are fewer than planned if all kinds of starts fail in turn. Fails if the case's
/// own shape cannot be solved, and with empty_shape if the case says no volume for its designs or none could
/// be drawn.
Expected<std::vector<Design>> planned_designs(const Case& c, const ExplorationPlan& plan,
                                              const DrawingSettings& settings = {});

/// Which of the previewed designs are optimized to the end: about a third of them, in spread_order().
std::vector<int> chosen_designs(const std::vector<RatedDesign>& previews,
                                const std::vector<RankedQuantity>& quantities);

/// The designs with what is known of them, after their runs to the given progression: those of a third were
/// chosen by their previews; then those that no other design beats. Stops where the settings ask for it.
/// Throws OutputError.
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
