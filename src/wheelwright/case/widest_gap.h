#pragma once

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The diameter of the largest circle that fits into the drawn holes of a case [m].
struct WidestGap {
  double diameter = 0;  ///< of a circle that fits; 0: there are no holes
  double at_most = 0;   ///< no larger one fits
};

/// Computes the width from the distance to the edges of plane shapes at many points. The case's shapes must
/// repeat in its sectors.
WidestGap widest_gap(const Case& c);

}  // namespace wheelwright
