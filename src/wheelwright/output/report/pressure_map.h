#pragma once

#include <span>
#include <string>

#include "wheelwright/output/report/pressure_csv.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The contact pressure of one load position of a 3D wheel, seen from above: every contact point as a
/// rectangle of its area, by its place along the ground and along the axle, in its colour; and the outline of
/// the wheel's width.
std::string pressure_map_svg(const std::string& title, const PolarGrid<3>& grid,
                             std::span<const ContactPoint> points);

}  // namespace wheelwright
