#pragma once

#include "wheelwright/output/report/svg.h"

namespace wheelwright {

/// Cubes per cell and axis of surfaces in pictures and files of a run.
inline constexpr int surface_parts = 2;

/// The boundary of a shape for pictures and files of a run. In 2D on the cells of the level set, in 3D on
/// those of the displacement, of this degree.
inline std::vector<Contour> shape_boundary(const LevelSet<2>& psi, int) {
  return material_contours(psi, contour_subdivisions(psi.lattice.degree()));
}
inline SurfaceMesh shape_boundary(const LevelSet<3>& psi, int displacement_degree) {
  return material_surface(psi, surface_parts, displacement_degree);
}

}  // namespace wheelwright
