#pragma once

#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/clearance.h"
#include "wheelwright/cad/outline_fault.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Minimum number of cells across a wall for an accurate stress.
inline constexpr double least_cells_per_wall = 3;

/// Warnings about an outline: a wall or gap more than 1 % narrower than the case allows, with its place, and
/// a wall of less than three cells that is not a band at rim or tread.
std::vector<std::string> feature_warnings(const Case& c, const cad::Clearances& measured);

/// The thinnest wall and the narrowest gap of the initial shape; in 3D of its section in the middle of the
/// width. Fails if no curves can be fitted.
Expected<cad::Clearances, cad::OutlineFault> initial_clearances(const Case& c);

}  // namespace wheelwright
