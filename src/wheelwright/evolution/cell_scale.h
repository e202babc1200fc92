#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// The level set that the values at the cells' vertices determine: the nodes between them are interpolated by
/// cubics (CubicInterpolant). A quadratic level set keeps its fourth-order geometry, but loses the shapes
/// that only the discretization can tell apart: boundaries that bulge in every cell lower the discrete energy
/// slightly, and grow in an optimization, without a meaning. Nodes that differ by more than a twentieth of a
/// cell from the cubic lie at a kink of the distance and stay. The identity for degree 1.
template <int dim>
LevelSet<dim> on_cell_scale(const LevelSet<dim>& psi);

}  // namespace wheelwright
