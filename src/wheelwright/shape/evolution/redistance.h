#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Reinitialization: returns the signed distance [m] to {psi = 0} at all nodes, with the signs of psi, by the
/// closest-point method (Chopp 2001; Saye 2014). The zero set is that of the cubic interpolant. Seed points
/// on it are computed once; the seed nearest to a node starts a Newton iteration for the closest point of the
/// zero set. Images of the zero set in the neighbouring sectors are included. Where the iteration fails, as
/// near corners of the zero set, the distance to the seed itself is taken. A psi of one sign is returned
/// unchanged.
template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi);

/// Coefficients (spline_level_set.h) that are about the signed distance to {psi = 0}, and whose spline has
/// this zero set. The distance has kinks midway between edges, which a spline rounds off: without corrections
/// the edges of its spline are off by up to a fifth of a cell at walls and gaps a few cells wide, with them
/// by less than a hundredth on average. A psi of one sign is returned unchanged.
template <int dim>
LevelSet<dim> redistanced_coefficients(const LevelSet<dim>& psi);

}  // namespace wheelwright
