#pragma once

#include "wheelwright/cad/drawing/png_file.h"

namespace wheelwright {

/// The outline of what is darker than the threshold in a picture of the wheel [m], with the axle in the
/// middle of the picture, which is `width` wide.
DrawnOutline wheel_outline(const Picture& picture, double threshold, double width);

/// The outline of the whole ring from the picture of one of its `count` equal parts, unrolled: columns are
/// azimuths, growing to the right from azimuth 0, and rows are radii, from the tread at the top to the rim at
/// the bottom.
DrawnOutline ring_outline(const Picture& picture, double threshold, int count, double inner_radius,
                          double outer_radius);

}  // namespace wheelwright
