#pragma once

#include <string>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// The outline as an SVG document at true scale: one user unit is a millimetre, y points down. The page
/// starts at (0, 0), which all programs understand; the group "wheel" moves the axle from the origin to the
/// middle of the page. It contains the path "material", filled by the even-odd rule, with one subpath per
/// loop: outer edge, bore, holes, islands. All of them are cubics and lines, because other programs coarsen
/// elliptic arcs.
std::string svg_outline(const WheelModel& wheel);

/// The profile in the same way, with the radius upwards and the axle as the centre line "axle".
std::string svg_outline(const TurnedModel& wheel);

}  // namespace wheelwright
