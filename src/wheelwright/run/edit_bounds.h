#pragma once

#include <optional>
#include <span>
#include <string>

#include "wheelwright/case/case.h"
#include "wheelwright/drawing/affine.h"

namespace wheelwright {

/// Why a line drawn with a round tip is refused on a wheel, in words, before anything is made of it: its tip
/// is not above 0 or larger than the wheel, a point of it is further from the axle than the diameter of the
/// wheel, or it misses the ring between rim and tread. Empty where it is not refused. The numbers may be any,
/// also not finite.
std::optional<std::string> refused_line(const Wheel& wheel, std::span<const Point> path, double radius);

/// The same of a polygon that a hole is to become, by its corners: all must be within the diameter of the
/// wheel.
std::optional<std::string> refused_hole(const Wheel& wheel, std::span<const Point> corners);

/// `(x, y) mm` of a place in metres.
std::string place_text(const Point& at);

}  // namespace wheelwright
