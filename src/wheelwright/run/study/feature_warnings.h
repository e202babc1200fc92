#pragma once

#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/case/case.h"
#include "wheelwright/output/report/described_wheel.h"

namespace wheelwright {

/// Minimum number of cells across a wall for an accurate stress.
inline constexpr double least_cells_per_wall = 3;

/// Warnings about an outline, each with its place: a wall or gap more than 1 % narrower than the case allows,
/// an internal corner whose radius is more than 5 % smaller, a wall of less than three cells that is not a
/// band at rim or tread, and closed cavities.
std::vector<std::string> feature_warnings(const Case& c, const OutlineMeasures& measures);

/// outline_measures() of the initial shape; in 3D with the roughness of its section in the middle of the
/// width.
Expected<OutlineMeasures, cad::OutlineFault> initial_outline_measures(const Case& c);

}  // namespace wheelwright
