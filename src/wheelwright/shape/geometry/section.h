#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The section of a shape by the plane in the middle of the wheel's width, exactly; with dim = 2 the shape
/// itself.
template <int dim>
LevelSet<2> mid_plane_section(const LevelSet<dim>& psi);

/// The section of a shape by a plane across the axle, exactly; `z` [m] from 0 to the width.
LevelSet<2> section_at(const LevelSet<3>& psi, double z);

/// The lattice of such sections.
Lattice<2> section_lattice(const Lattice<3>& lattice);

/// The shape with the same section everywhere, given on section_lattice(lattice).
LevelSet<3> extruded(const LevelSet<2>& section, const Lattice<3>& lattice);

}  // namespace wheelwright
