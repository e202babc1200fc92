#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/design/explore/pareto.h"
#include "wheelwright/design/explore/quantity.h"

namespace wheelwright {

/// One wheel of an exploration or a sweep, before it is optimized.
struct Design {
  std::string name;  ///< of its run's folder, e.g. "007"
  std::string text;  ///< description of its start
  Case source;
  std::vector<std::pair<std::string, double>> parameters;  ///< that distinguish it, for the table
};

/// How far the run of a design went.
enum class Progression {
  preview,  ///< a few shapes, or the coarse grids if the case has them; evaluated on the case's grid
  full,     ///< until the run ends by itself
};

/// The result of a design. Contains no times, so that it is the same after a kill and a resumption.
struct DesignResult {
  Progression progression;
  std::string status;  ///< why the run ended, as in StopReason; or why it did not start
  int shapes = 0;
  /// By their keys in summary.json, and by key_in_case() under other load cases; empty if the run has no
  /// results.
  std::map<std::string, double> numbers = {};
  double violation = 0;  ///< the largest one, as a fraction of the bound; 0: all bounds are kept

  /// In SI units; NaN if it is not known.
  double value(const RankedQuantity& quantity) const;
  double value(const std::string& key) const;
};

/// The key of a number under a load case other than the first, e.g. "run_out_m in kerb".
std::string key_in_case(std::string_view key, std::string_view load_case);

/// The names of a case's load cases except the first, whose keys have no suffix.
std::vector<std::string> other_load_cases(const Case& c);

/// The numbers of a design's last shape on a finer grid. Contains no times either.
struct FinerNumbers {
  std::string grid = {};     ///< e.g. "56 x 768 cells"
  std::string failure = {};  ///< why there are no numbers; empty: there are
  /// By the keys of DesignResult::numbers, of which some are missing: those of the outline.
  std::map<std::string, double> numbers = {};
  std::map<std::string, double> errors = {};  ///< estimates of their discretization errors
  double violation = 0;                       ///< of a bound on this grid, as DesignResult::violation
};

/// A design with its result.
struct RatedDesign {
  Design design;
  DesignResult result;
  std::optional<FinerNumbers> finer = {};  ///< of finalists (design/explore/finalists.h)

  /// On the finer grid if it is known there, in SI units; NaN if it is not known at all.
  double value(const std::string& key) const;
  /// The estimate of its error; nothing if it is not known.
  std::optional<double> error(const std::string& key) const;
};

/// Returns the costs by which designs are ranked: to be minimized, in the order of the quantities, on their
/// own grids.
std::vector<RatedPoint> rated_points(const std::vector<RatedDesign>& designs,
                                     const std::vector<RankedQuantity>& quantities);

/// The same on the finer grid for those designs that have numbers there.
std::vector<RatedPoint> finest_points(const std::vector<RatedDesign>& designs,
                                      const std::vector<RankedQuantity>& quantities);

/// Conversion to and from its own file; throws std::exception if the text is invalid.
std::string to_json(const DesignResult& result);
DesignResult design_result(const std::string& json);
std::string to_json(const FinerNumbers& finer);
FinerNumbers finer_numbers(const std::string& json);

}  // namespace wheelwright
