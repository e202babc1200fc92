#pragma once

#include <vector>

#include "wheelwright/cad/drawing/composition.h"

namespace wheelwright {

/// The distance between a boundary and itself after a turn.
struct Asymmetry {
  double distance = 0;  ///< [m]
  Point at{};           ///< the point of the boundary, before the turn, that ends up so far from it
};

/// The largest distance between the boundary of a shape and the same boundary after turns about the axle by
/// multiples of a full turn / n. The search ends where it reaches `most` [m], which is then the distance; so
/// it is if the boundaries coincide, but material lies where a hole was.
Asymmetry asymmetry(const Composition& shape, int n, double most);

/// Whether a turn about the axle by a full turn / n leaves the shape as it is, within the tolerance [m].
bool repeats(const Composition& shape, int n, double tolerance);

}  // namespace wheelwright
