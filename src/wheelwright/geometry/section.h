#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// The section of a shape by the plane in the middle of the wheel's width, exactly; with dim = 2 the shape
/// itself.
template <int dim>
LevelSet<2> mid_plane_section(const LevelSet<dim>& psi);

}  // namespace wheelwright
