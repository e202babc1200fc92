#pragma once

#include <limits>

namespace wheelwright {

/// Between which bounds a function should stay.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

}  // namespace wheelwright
