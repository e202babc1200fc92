#pragma once

#include <string>

#include "wheelwright/export/wheel_model.h"

namespace wheelwright {

/// The outline as an SVG document in true scale: one user unit is a millimetre, y points down. The page
/// begins at (0, 0), which all programs understand; the group "wheel" moves the axle from the origin to the
/// middle of the page. It holds the path "material", which is filled by the even-odd rule, with one subpath
/// per loop: the outer edge, the bore, the holes, the islands. All of them are cubics and lines: other
/// programs coarsen elliptic arcs.
std::string svg_outline(const WheelModel& wheel);

}  // namespace wheelwright
