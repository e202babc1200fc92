#pragma once

#include <vector>

#include "wheelwright/mechanics/state/load_positions.h"
#include "wheelwright/mechanics/state/ring_field.h"

namespace wheelwright {

/// The displacement of a solved load position, from which that of a similar shape may be sought.
struct StartDisplacement {
  GroundPosition ground;
  /// Polar components at all nodes of the ring, without the rim's motion [m].
  RingField displacement;
};

/// The displacements of all positions of a shape under one load; empty where no start is needed.
using StartDisplacements = std::vector<StartDisplacement>;

/// Returns the displacement of a position; null if there is none.
inline const StartDisplacement* start_of(const StartDisplacements& starts, const GroundPosition& ground) {
  for (const StartDisplacement& start : starts)
    if (start.ground == ground) return &start;
  return nullptr;
}

}  // namespace wheelwright
