#pragma once

#include <optional>

#include "wheelwright/shape/evolution/cubic_interpolant.h"

namespace wheelwright {

/// Physical distance [m] of two points given in units of the node spacing of the lattice. Images of the
/// points in other sectors are not considered.
template <int dim>
double physical_distance(const Lattice<dim>& lattice, const Vec<dim>& a, const Vec<dim>& b);

/// The point of {psi = 0} reached by Newton's method along the gradient from `start`. Empty if it does not
/// converge within one node spacing of `start`. Points are in units of the node spacing of the lattice.
template <int dim>
std::optional<Vec<dim>> project_to_zero(const CubicInterpolant<dim>& psi, const Vec<dim>& start);

/// The point x of {psi = 0} closest to `target`, by Newton's method for a stationary point of the Lagrangian
/// |x - target|^2 / 2 + m psi(x), started at `seed`, a nearby point of {psi = 0}. Empty if the iteration
/// leaves the neighbourhood of the seed or its result is farther from the target than the seed.
template <int dim>
std::optional<Vec<dim>> closest_zero(const CubicInterpolant<dim>& psi, const Vec<dim>& target,
                                     const Vec<dim>& seed);

}  // namespace wheelwright
