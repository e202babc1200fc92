#pragma once

#include <span>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// A circular hole with its centre in polar coordinates of the ring. When dim = 3 it is a cylinder parallel
/// to the axle.
struct Circle {
  double centre_radius;   ///< distance of the hole's centre from the axle [m]
  double centre_azimuth;  ///< [rad]
  double hole_radius;     ///< [m]
};

/// Signed distance [m] to the boundary of the union of `holes` and of their images in all sectors; positive
/// inside a hole. Inside overlapping holes it is a lower bound of the distance. Without holes it is minus the
/// thickness of the ring.
template <int dim>
double signed_distance(const PolarGrid<dim>& grid, std::span<const Circle> holes, const Vec<dim>& polar);

/// Returns the level set whose nodal values are this signed distance.
template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, std::span<const Circle> holes);

}  // namespace wheelwright
