#pragma once

#include <optional>
#include <span>
#include <string>

#include "wheelwright/cad/curves/affine.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Why a line drawn with a round brush is refused for a wheel, as text: the brush is not above 0 or is larger
/// than the wheel, a point is farther from the axle than the wheel's diameter, or the line misses the ring
/// between rim and tread. Empty if it is accepted. Numbers may be arbitrary, even not finite.
std::optional<std::string> refused_line(const Wheel& wheel, std::span<const Point> path, double radius);

/// The same for the corners of a polygon that is to become a hole: all must be within the wheel's diameter of
/// the axle.
std::optional<std::string> refused_hole(const Wheel& wheel, std::span<const Point> corners);

/// A place in metres as `(x, y) mm`.
std::string place_text(const Point& at);

}  // namespace wheelwright
