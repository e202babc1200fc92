#pragma once

#include "wheelwright/cad/drawing/composition.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Signed distance [m] to the boundary at the nodes, positive in the holes; without a boundary minus the
/// thickness of the ring. The composition must be the same in all sectors. When dim = 3 the shape is a
/// cylinder along the axle.
template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, const Composition& composition);

}  // namespace wheelwright
