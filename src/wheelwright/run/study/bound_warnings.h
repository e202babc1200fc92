#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Bounds of a 2D case that look like values of the whole width, whereas bounds are per metre of width: those
/// that are closer to the initial shape's value on the whole width than to that per metre, computed on a
/// coarse grid. Empty in 3D, and if the shape cannot be computed.
std::vector<std::string> bound_warnings(const Case& c);

}  // namespace wheelwright
