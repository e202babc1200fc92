#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/explore/pareto.h"
#include "wheelwright/explore/quantity.h"

namespace wheelwright {

/// One wheel of an exploration or a sweep, before it is optimized.
struct Design {
  std::string name;  ///< of its run's folder, e.g. "007"
  std::string text;  ///< what it begins with, for people
  Case source;
  std::vector<std::pair<std::string, double>> parameters;  ///< in which it differs, for the table
};

/// How far the run of a design went.
enum class Progression {
  preview,  ///< optimized by a few shapes, or on coarse grids if the case has them, and evaluated on its own
  full,     ///< until the run ended by itself
};

/// What became of a design. The same after a kill and a resumption: it holds no times.
struct DesignResult {
  Progression progression;
  std::string status;  ///< why the run ended, as in StopReason; or why it did not begin
  int shapes = 0;
  /// By their keys in summary.json, and by key_in_case() under other load cases; empty if the run has no
  /// results.
  std::map<std::string, double> numbers = {};
  double violation = 0;  ///< the largest one of a bound, as a fraction of the bound; 0: all are kept

  /// In SI units; NaN if it is not known.
  double value(const RankedQuantity& quantity) const;
  double value(const std::string& key) const;
};

/// The key of a number under another load case than the first one, e.g. "run_out_m in kerb".
std::string key_in_case(std::string_view key, std::string_view load_case);

/// The names of a case's load cases but the first one, whose numbers have no addition.
std::vector<std::string> other_load_cases(const Case& c);

/// A design with its result.
struct RatedDesign {
  Design design;
  DesignResult result;
};

/// By what designs are ranked; the costs are small for good designs, in the order of the quantities.
RatedPoint rated_point(const DesignResult& result, const std::vector<RankedQuantity>& quantities);
std::vector<RatedPoint> rated_points(const std::vector<RatedDesign>& designs,
                                     const std::vector<RankedQuantity>& quantities);

/// As a file of its own, and back; throws std::exception on a text that is none.
std::string to_json(const DesignResult& result);
DesignResult design_result(const std::string& json);

}  // namespace wheelwright
