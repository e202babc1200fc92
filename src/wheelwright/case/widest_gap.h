#pragma once

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The diameter of the largest circle that fits into the drawn holes of a case [m].
struct WidestGap {
  double diameter = 0;  ///< of one that was found; 0: there are no holes
  double at_most = 0;   ///< no larger one fits
};

/// The case has plane shapes that repeat in its sectors. The width is found from the distance to their edges at many points.
WidestGap widest_gap(const Case& c);

}  // namespace wheelwright
