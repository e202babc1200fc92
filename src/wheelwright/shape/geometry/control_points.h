#pragma once

#include <vector>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

// The Bezier control points of a level set in every cell, of its own degree. They have the places of the
// nodes and are shared by neighbouring cells like them. The level set lies between the smallest and the
// largest one of a cell, and where they rise along an axis it rises along all lines parallel to that axis
// (nodal values of degree 2 promise neither).

template <int dim>
std::vector<double> control_points(const LevelSet<dim>& psi);

/// The level set with these control points.
template <int dim>
LevelSet<dim> of_control_points(const Lattice<dim>& lattice, std::vector<double> control_points);

}  // namespace wheelwright
