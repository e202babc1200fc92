#pragma once

#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// The same surface by fewer triangles: vertices are moved along edges to neighbours and removed as long as
/// the triangles of holes stay within `tolerance` [m] of {psi = 0} and keep facing away from the material,
/// those of rim and tread stay within the tolerance of their cylinders, and the side faces stay plane. The
/// edges between these parts keep their vertices or lose them along themselves. All sectors are treated
/// alike.
SurfaceMesh simplified(const SurfaceMesh& mesh, const LevelSet<3>& psi, double tolerance);

}  // namespace wheelwright
