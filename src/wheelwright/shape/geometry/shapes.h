#pragma once

#include <optional>
#include <span>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// A circular hole with its centre in polar coordinates of the ring. When dim = 3 it is a cylinder parallel
/// to the axle.
struct Circle {
  double centre_radius;   ///< distance of the hole's centre from the axle [m]
  double centre_azimuth;  ///< [rad]
  double hole_radius;     ///< [m]
};

/// A spherical hole. Heights are along the axle, from the first side face.
struct Sphere {
  double centre_radius, centre_azimuth, centre_height;  ///< [m, rad, m]
  double hole_radius;                                   ///< [m]
};

/// A round hole parallel to the axle whose radius changes along it: linear between the points (height,
/// radius), which ascend, and constant beyond them. Where the radius is negative there is no hole.
struct TaperedHole {
  double centre_radius, centre_azimuth;  ///< [m, rad]
  std::vector<Vec<2>> profile;           ///< [m]
};

/// A groove around the axle in a side face, a rectangle in the section through the axle with rounded corners,
/// or with a floor that leans.
struct Groove {
  double inner_radius, outer_radius;    ///< of its sides [m]
  double face;                          ///< height of the side face [m]
  double depth, fillet;                 ///< [m]
  std::optional<double> outer_depth{};  ///< the depth at its outer side, if its floor leans [m]
};

/// Signed distance [m] to the boundary of a hole and its images in all sectors; positive inside.
double signed_distance(const PolarGrid<3>& grid, const Sphere& hole, const Vec<3>& polar);
double signed_distance(const PolarGrid<3>& grid, const TaperedHole& hole, const Vec<3>& polar);
double signed_distance(const PolarGrid<3>& grid, const Groove& hole, const Vec<3>& polar);

/// Signed distance [m] to the boundary of the union of `holes` and of their images in all sectors; positive
/// inside a hole. Inside overlapping holes it is a lower bound of the distance. Without holes, minus the
/// thickness of the ring.
template <int dim>
double signed_distance(const PolarGrid<dim>& grid, std::span<const Circle> holes, const Vec<dim>& polar);

/// Adds a hole to a shape given by signed distances.
template <class Hole>
LevelSet<3> with_hole(LevelSet<3> psi, const Hole& hole) {
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    psi.values[node] =
        std::max(psi.values[node], signed_distance(psi.lattice.grid(), hole, psi.lattice.polar_point(node)));
  return psi;
}

/// Returns the level set whose nodal values are this signed distance.
template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, std::span<const Circle> holes);

}  // namespace wheelwright
