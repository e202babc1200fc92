#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// Coefficients (spline_level_set.h) that are about the signed distance to {psi = 0}, and whose spline has
/// this zero set. The distance has kinks midway between edges, which a spline rounds off: without corrections
/// the edges of its spline are off by up to a fifth of a cell at walls and gaps a few cells wide, with them
/// by less than a hundredth on average. A psi of one sign is returned unchanged.
template <int dim>
LevelSet<dim> redistanced_coefficients(const LevelSet<dim>& psi);

}  // namespace wheelwright
