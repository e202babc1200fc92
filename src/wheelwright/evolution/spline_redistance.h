#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// Coefficients (spline_level_set.h) that are about the signed distance to {psi = 0}, and whose spline has
/// this zero set. The distance has kinks midway between edges, which a spline rounds off: without corrections
/// the edges of its spline lie up to a fifth of a cell elsewhere at walls and gaps a few cells wide, and with
/// them by less than a hundredth on average. A psi of one sign stays as it is.
template <int dim>
LevelSet<dim> redistanced_coefficients(const LevelSet<dim>& psi);

}  // namespace wheelwright
