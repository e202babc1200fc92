#pragma once

#include "wheelwright/shape/geometry/print.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// An angle between the surface of holes and the axle, averaged over the triangles around a vertex, and where
/// it is.
struct AxialAngle {
  double angle;  ///< [rad]; infinite if there are no holes
  Vec<3> place;  ///< (radius, azimuth, axial)
};

/// The smallest draft of a mould whose halves meet at z = parting_plane: the angle by which the surface of
/// holes faces the half that moves away from it. Negative: an undercut.
AxialAngle smallest_draft(const SurfaceMesh& mesh, double parting_plane);

/// The largest overhang of a print that stands on this side face: the angle by which the surface of holes
/// faces the plate. Negative if it does nowhere; minus infinity if there are no holes.
AxialAngle largest_overhang(const SurfaceMesh& mesh, SideFace plate);

}  // namespace wheelwright
