#pragma once

#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// The largest distance of a surface from the level set's.
struct SurfaceDeviation {
  double distance;  ///< [m]
  Vec<3> place;     ///< (radius, azimuth, axial) [m, rad, m]
};

/// The distance of the centres of the holes' triangles from {psi = 0}, |psi| / |grad psi|, on isoparametric
/// cells of degree `map_degree`. The vertices are closer. Without holes it is 0.
SurfaceDeviation deviation(const SurfaceMesh& mesh, const LevelSet<3>& psi, int map_degree);

}  // namespace wheelwright
