#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/units.h"

namespace wheelwright {

/// A number of a wheel at the end of a refinement of its grid.
struct AccurateNumber {
  std::string label, key;
  UnitKind kind;
  ShownUnit shown;
  double value;                 ///< in SI units, on the whole width
  std::optional<double> error;  ///< the estimate of its discretization error; nothing if there is none
  std::string reason;           ///< why it is not as accurate as wanted; empty: it is
};

/// The numbers after solutions on finer and finer grids.
struct AccurateNumbers {
  double accuracy;   ///< that was wanted, relative to each number
  std::string grid;  ///< of the numbers, e.g. "56 x 768 cells"
  std::vector<AccurateNumber> numbers;
};

/// For display: one line per number with its error, and why it is not as accurate as wanted.
std::string accuracy_table(const AccurateNumbers& numbers);

}  // namespace wheelwright
