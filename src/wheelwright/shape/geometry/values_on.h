#pragma once

#include <string>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Why a shape cannot be transferred to another grid, as text; empty if it can. The rings must be equal (in
/// 2D with any width), and the new number of sectors must divide that of the shape.
template <int dim>
std::string misfit(const PolarGrid<dim>& of_shape, const PolarGrid<dim>& grid);

/// Whether two lattices have the same nodes around the full ring.
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
