#pragma once

#include <string>

namespace wheelwright {

/// Wall time of one phase of a computation.
struct PhaseTime {
  std::string phase;
  double seconds;
};

}  // namespace wheelwright
