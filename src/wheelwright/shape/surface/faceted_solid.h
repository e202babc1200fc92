#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/surface/check_surface.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// A solid between plane side faces by its faces: exact cylinders at rim and tread where no hole reaches
/// them, planes at the side faces, and triangles elsewhere.
struct FacetedSolid {
  /// A connected face across the axle. Its loops have the material on the left as seen from outside.
  struct SideFace {
    bool is_last;                            ///< at z = width, not at z = 0
    bool ends_at_rim, ends_at_tread;         ///< along the circle of a cylinder
    std::vector<std::vector<int>> polygons;  ///< its other loops, by points
    int shell;
  };
  struct Triangle {
    std::array<int, 3> corners;  ///< counter-clockwise as seen from outside
    int shell;
  };

  double inner_radius, outer_radius, width;  ///< [m]
  bool has_rim_cylinder, has_tread_cylinder;
  int shell_of_rim, shell_of_tread;  ///< of these cylinders
  int n_shells;                      ///< connected pieces of the surface; bodies and closed cavities
  std::vector<Vec<3>> points;        ///< Cartesian [m], body frame; z from 0 to the width
  std::vector<SideFace> side_faces;
  std::vector<Triangle> triangles;

  std::size_t n_faces() const {
    return side_faces.size() + triangles.size() + has_rim_cylinder + has_tread_cylinder;
  }
};

/// The faces of a closed surface of a ring with these radii and this width [m].
FacetedSolid faceted_solid(const SurfaceMesh& mesh, double inner_radius, double outer_radius, double width);

/// Enclosed volume [m^3].
double enclosed_volume(const FacetedSolid& solid);

}  // namespace wheelwright
