#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The sub-cell filter: replaces the nodal values between the vertices of the cells by a cubic interpolation
/// of the values at the vertices (CubicInterpolant). A quadratic level set keeps its fourth-order geometry
/// but loses variations below the size of a cell. Such variations have no physical meaning: a boundary that
/// bulges in each cell lowers the discrete energy slightly, so that the bulges would grow during an
/// optimization. A nodal value that differs from the cubic by more than a twentieth of the resolution lies at
/// a kink of the distance function and is kept. For degree 1 the filter is the identity.
template <int dim>
LevelSet<dim> sub_cell_filter(const LevelSet<dim>& psi);

}  // namespace wheelwright
