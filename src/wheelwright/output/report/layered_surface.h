#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/geometry/polar_grid.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// A surface with separate vertices for each layer of materials where layers meet, so that fields jump there.
struct LayeredSurface : SurfaceMesh {
  /// The edges where layers meet, by the vertices of the inner one; those of sector 0 come first, then those
  /// of sector 1 and so on.
  std::vector<std::array<int, 2>> layer_edges;
};

/// `radii`: of the circles between layers, on lines of the grid [m]. Without any, the same surface.
LayeredSurface layered_surface(SurfaceMesh mesh, const PolarGrid<3>& grid, const std::vector<double>& radii);

}  // namespace wheelwright
