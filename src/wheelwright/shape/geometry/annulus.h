#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The part of a shape in the radial rows of cells from `first` to before `end`, as a shape of its own: its
/// rim and its tread are the lines of the grid there.
template <int dim>
LevelSet<dim> in_rows(const LevelSet<dim>& psi, int first, int end);

}  // namespace wheelwright
