#pragma once

#include <string>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// Why a shape of one grid cannot stand on another one, in words; empty if it can. The rings must be equal
/// (in 2D of any width), and the new sector a whole number of the shape's own: the new number of sectors must
/// divide the shape's.
template <int dim>
std::string misfit(const PolarGrid<dim>& of_shape, const PolarGrid<dim>& grid);

/// Whether two lattices have the same nodes round the full ring.
template <int dim>
bool have_same_nodes(const Lattice<dim>& a, const Lattice<dim>& b);

/// The piecewise polynomial at a point (radius, azimuth[, axial]) of the ring; the azimuth may lie in any
/// sector [m].
template <int dim>
double value_at(const LevelSet<dim>& psi, const Vec<dim>& polar);

/// The piecewise polynomial at the nodes of a lattice that the shape fits (misfit()); where the nodes are the
/// same, its own values to the last bit.
template <int dim>
LevelSet<dim> values_on(const LevelSet<dim>& psi, const Lattice<dim>& lattice);

}  // namespace wheelwright
