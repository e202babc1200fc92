#pragma once

#include <vector>

#include "wheelwright/shape/evolution/cubic_interpolant.h"

namespace wheelwright {

/// Points on {psi = 0} in one sector, about a third of the node spacing apart: one on each edge of the
/// lattice whose ends differ in sign, and the projections of sample points in elements whose corners differ
/// in sign. The points are in units of the node spacing of the lattice.
template <int dim>
std::vector<Vec<dim>> zero_seeds(const CubicInterpolant<dim>& psi);

/// The points of one sector and their images in the two neighbouring sectors.
template <int dim>
std::vector<Vec<dim>> with_images(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& points);

/// Converts a point in units of the node spacing to the body frame [m].
template <int dim>
Vec<dim> cartesian_position(const Lattice<dim>& lattice, const Vec<dim>& point);

}  // namespace wheelwright
