#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// Reinitialization: returns the signed distance [m] to {psi = 0} at all nodes, with the signs of psi, by the
/// closest-point method (Chopp 2001; Saye 2014). The zero set is that of the cubic interpolant. Seed points
/// on it are computed once; the seed nearest to a node starts a Newton iteration for the closest point of the
/// zero set. Images of the zero set in the neighbouring sectors are included. Where the iteration fails, as
/// near corners of the zero set, the distance to the seed itself is taken. A psi of one sign is returned
/// unchanged.
template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi);

}  // namespace wheelwright
