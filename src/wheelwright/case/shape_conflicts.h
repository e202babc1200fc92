#pragma once

#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/drawn_shapes.h"

namespace wheelwright {

/// Conflicts of the `[[shape.*]]` of a case, whose curves are `shapes`: keys that contradict each other,
/// holes beyond the bands, material beyond the ring, outlines that cross themselves, too many curves,
/// drawings that are not the same in all sectors.
std::vector<Conflict> shape_conflicts(const Case& c, const std::vector<DrawnShape>& shapes);

/// The addition to a remedy if a length is so much larger than another one of the wheel that it may be in
/// millimetres; otherwise empty.
std::string if_in_millimetres(double length, double other);

/// `keys`, followed by the keys that determine where holes may be.
std::vector<std::string> with_ring_shape(std::vector<std::string> keys);

}  // namespace wheelwright
