#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/output/report/accurate_numbers.h"
#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/quantities/analysis/fatigue_damage.h"
#include "wheelwright/quantities/analysis/fatigue_results.h"
#include "wheelwright/quantities/analysis/ground_pass.h"
#include "wheelwright/quantities/analysis/heat_results.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/quantities/analysis/rolling_losses.h"

namespace wheelwright {

/// The same analysis on a finer grid, for estimates of the errors.
struct FinerReport {
  RollingAnalysis analysis;
  std::vector<Expected<std::vector<ContactSummary>>> under_loads;
  double refinement;  ///< the factor by which its cells are smaller
  std::optional<Expected<RollingLosses>> losses = {};
  std::optional<Expected<FatigueResults>> fatigue = {};
  std::optional<Expected<FatigueDamage>> damage = {};
  std::optional<Expected<HeatResults>> heat = {};
};

/// The analysis of one shape. Forces are shown on the whole width.
struct RollingReport {
  std::string title;
  double width;  ///< w_r [m]
  int n_sectors;
  RollingAnalysis analysis;
  std::vector<double> loads;  ///< as in the analysis, ascending; empty: none were requested
  std::vector<Expected<std::vector<ContactSummary>>> under_loads;  ///< [load][position]
  int dimension = 2;                                               ///< of the analysis
  /// Nothing: no errors are wanted; the reason if they cannot be estimated.
  std::optional<Expected<FinerReport, std::string>> finer = {};
  std::optional<AccurateNumbers> accurate = {};          ///< if an accuracy was wanted
  std::optional<Expected<RollingLosses>> losses = {};    ///< if the loss factors are known
  std::optional<Expected<FatigueResults>> fatigue = {};  ///< if the fatigue strengths are known
  std::optional<Expected<HeatResults>> heat = {};        ///< if temperatures are known
  double outer_radius = 0;                               ///< R_e, for lives as distances [m]
  /// By all load cases of the wheel together, of these names, if their shares of the distance are known.
  std::optional<Expected<FatigueDamage>> damage = {};
  std::vector<std::string> load_cases = {};
  bool is_linear = true;             ///< the theory; else large deformation
  bool is_ground_flat = true;        ///< else the error of linear theory lacks a part
  std::vector<PassPlace> pass = {};  ///< of the ground below; empty: was not requested
};

/// For display: one line per load position, another one if there is friction or torque, variations in
/// rolling, one line per layer of materials, the rolling resistance and the fatigue if they are known, one
/// line per load, and what could not be computed and why; the pass_table() if it was requested. A line below
/// the positions has the largest error of each column, and one below each variation its errors. Last, the
/// accuracy_table().
std::string rolling_table(const RollingReport& report);

/// For programs: the same in SI units, named at the end of the keys. Numbers read back to the same double;
/// missing numbers are null, and `missing` has their names with the reason. `errors` beside numbers has the
/// estimates of their errors; `missing_errors` says why there are none.
std::string rolling_json(const RollingReport& report);

/// One turn of the wheel by one sector, closed: travel of the rim at fixed load, force of the ground at fixed
/// travel, and the peak of the contact pressure, with bands of their errors. Must not be called if the values
/// could not be computed.
LinePlot travel_plot(const RollingReport& report);
LinePlot force_plot(const RollingReport& report);
LinePlot peak_pressure_plot(const RollingReport& report);

/// Travel against load, from zero: the softest position, the mean and the stiffest.
LinePlot load_plot(const RollingReport& report);

/// Against load: the load by the mean travel, and its derivative with respect to that.
LinePlot stiffness_plot(const RollingReport& report);

}  // namespace wheelwright
