#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/shape/surface/check_surface.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// The closed surface of a solid by triangles whose normals point outwards, in millimetres, as in files.
struct SolidMesh {
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<int, 3>> triangles;
};

/// A surface as in files.
SolidMesh solid_mesh(const SurfaceMesh& surface);

/// Whether the numbers of a file bound a solid (check_surface()); volumes in mm^3.
Expected<SurfaceReport, SurfaceFault> check_solid(const SolidMesh& mesh);

/// The solid as a binary STL file. `header` describes it.
std::string stl_file(const SolidMesh& mesh, std::string_view header);

}  // namespace wheelwright
