#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// What the initial shape of a case, computed on a coarse grid, says about its bounds.
struct PredictedBounds {
  std::string note;  ///< a line for each bound that it violates
  /// Of bounds that look like values of the whole width, whereas bounds are per metre of width: those that
  /// are closer to the initial shape's value on the whole width than to that per metre.
  std::vector<std::string> warnings;
};

/// Empty in 3D, and if the shape cannot be computed.
PredictedBounds predicted_bounds(const Case& c);

}  // namespace wheelwright
