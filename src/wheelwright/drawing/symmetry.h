#pragma once

#include <vector>

#include "wheelwright/drawing/composition.h"

namespace wheelwright {

/// Whether a turn about the axle by a full turn / n leaves the shape as it is, within the tolerance [m].
bool repeats(const Composition& shape, int n, double tolerance);

/// All n up to `most` for which it does, from 1.
std::vector<int> repetitions(const Composition& shape, int most, double tolerance);

}  // namespace wheelwright
