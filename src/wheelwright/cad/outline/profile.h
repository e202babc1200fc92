#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/shape/geometry/turned_section.h"

namespace wheelwright::cad {

// The profile of a body of revolution is the outline of its section by a half-plane through the axle. Its
// points are (axial, radius) [m]. The first loop encloses a piece of material and is an outer edge, those of
// further pieces are islands, and closed cavities are holes.

/// The boundary of {psi < 0} in a section by few curves. Where the material ends at the sides of the section,
/// its rectangle, they are exact lines. The others deviate by at most `tolerance` [m] from {psi = 0}, as in
/// fit_outline(). Parts of the boundary that are mirror images in the middle of the width get mirrored
/// curves. Fails where there is no material, and where no curve follows the contour.
Expected<Outline, OutlineFault> fit_profile(const TurnedSection& section, double tolerance);

/// Volume of the body that a profile encloses as it turns about the axle [m^3], exactly.
double volume_of_revolution(const Outline& profile);

/// A point of a section as text, e.g. "radius 270.1 mm, z = 12.3 mm".
std::string place_in_section(const Vec<2>& point);

}  // namespace wheelwright::cad
