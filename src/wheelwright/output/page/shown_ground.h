#pragma once

#include <optional>
#include <vector>

#include "wheelwright/output/report/solution_fields.h"

namespace wheelwright {

/// The ground below a wheel as the pages draw it.
struct ShownGround {
  std::vector<Vec<2>> outline;  ///< ground_outline(); empty if the tread touches none
  double camber = 0;            ///< of the wheel on it; when dim = 3 [rad]
};

/// That of a load position; nothing if it is flat, below an upright wheel, which the pages know.
template <int dim>
std::optional<ShownGround> shown_ground(const PositionFields<dim>& fields);

}  // namespace wheelwright
