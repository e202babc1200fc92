#pragma once

#include <vector>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// The points of {psi = 0} that are closest to the nodes, one for each, in units of the node spacing of the
/// lattice: those of redistance(). They may lie in the neighbouring sectors. Empty where psi has one sign.
template <int dim>
std::vector<Vec<dim>> closest_points(const LevelSet<dim>& psi);

/// The distances of the nodes from these points, with the signs of psi; psi itself where there are none.
template <int dim>
LevelSet<dim> signed_distances(const LevelSet<dim>& psi, const std::vector<Vec<dim>>& closest);

/// Reinitialization: returns the signed distance [m] to {psi = 0} at all nodes, with the signs of psi, by the
/// closest-point method (Chopp 2001; Saye 2014). The zero set is that of the cubic interpolant. Seed points
/// on it are computed once; the seed nearest to a node starts a Newton iteration for the closest point of the
/// zero set. Images of the zero set in the neighbouring sectors are included. Where the iteration fails, as
/// near corners of the zero set, the distance to the seed itself is taken. A psi of one sign is returned
/// unchanged.
template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi);

}  // namespace wheelwright
