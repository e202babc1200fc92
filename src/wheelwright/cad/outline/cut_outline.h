#pragma once

#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/outline.h"

namespace wheelwright::cad {

/// The parts of the material between circles about the axle of these ascending radii, from the bore to the
/// outer edge: one more than radii, each with closed loops of its own. They are cut exactly: pieces of the
/// outline's curves are joined by arcs of the circles, which are those of both neighbours. The outline must
/// be one that check_outline() accepts, of material that is connected. Fails where rounding decides whether
/// an edge crosses a circle.
Expected<std::vector<Outline>, OutlineFault> cut_by_circles(const Outline& outline,
                                                            const std::vector<double>& radii);

/// A part of a curve between two parameters in [0, 1], s0 < s1.
Curve part(const Curve& curve, double s0, double s1);

}  // namespace wheelwright::cad
