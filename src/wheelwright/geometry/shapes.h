#pragma once

#include <span>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// A circular hole, its centre given in polar coordinates of the ring; a cylinder along the axle when dim
/// = 3.
struct Circle {
  double centre_radius;   ///< distance of the hole's centre from the axle [m]
  double centre_azimuth;  ///< [rad]
  double hole_radius;     ///< [m]
};

/// Signed distance to the edge of the union of `holes` and of their images in all sectors; positive inside a
/// hole. Where holes overlap, their insides get a lower bound of the distance. Without holes: minus the
/// thickness of the ring.
template <int dim>
double signed_distance(const PolarGrid<dim>& grid, std::span<const Circle> holes, const Vec<dim>& polar);

/// The level set whose nodal values are that signed distance.
template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, std::span<const Circle> holes);

}  // namespace wheelwright
