#pragma once

#include <optional>

#include "wheelwright/evolution/cubic_interpolant.h"

namespace wheelwright {

/// Physical distance of two points given in units of the lattice's node spacing; the azimuths as they are,
/// without images.
template <int dim>
double physical_distance(const Lattice<dim>& lattice, const Vec<dim>& a, const Vec<dim>& b);

/// The point of {psi = 0} that Newton's method along the gradient reaches from `start`, if it does so within
/// one node spacing. Points are in units of the lattice's node spacing.
template <int dim>
std::optional<Vec<dim>> project_to_zero(const CubicInterpolant<dim>& psi, const Vec<dim>& start);

/// The point of {psi = 0} closest to `target`: Newton's method on the Lagrangian |x - target|^2 / 2 + m
/// psi(x), from the nearby zero point `seed`. Empty where it leaves the seed's neighbourhood or does not
/// improve on it.
template <int dim>
std::optional<Vec<dim>> closest_zero(const CubicInterpolant<dim>& psi, const Vec<dim>& target,
                                     const Vec<dim>& seed);

}  // namespace wheelwright
