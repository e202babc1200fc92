#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// A shape on another lattice that it fits (shape/geometry/values_on.h). Where the nodes are the same, its
/// values are unchanged to the last bit. Otherwise the piecewise polynomial is evaluated at the nodes,
/// redistanced and filtered (sub_cell_filter.h): edges move by the error of interpolation on the coarser
/// grid. A mirror-symmetric shape stays so.
template <int dim>
LevelSet<dim> regrid(const LevelSet<dim>& psi, const Lattice<dim>& lattice);

}  // namespace wheelwright
