#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// The signed distance to {psi = 0} at every node, with the nodes' signs kept: the closest-point method
/// (Chopp 2001; Saye 2014). The zero line is that of the cubic through the nodal values; seeds on it are
/// found once, each node's nearest seed starts a Newton iteration for the closest point. Distances are
/// physical, and the line's images in the neighbouring sectors count. Near corners of the line the nearest
/// seed itself is taken. A psi of one sign comes back unchanged.
template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi);

}  // namespace wheelwright
