#pragma once

#include <string>

#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/output/report/solid_mesh.h"

namespace wheelwright {

/// A plane wheel as CAD and workshop programs see it: an outline, and the solid obtained by extruding it
/// along the axle. Files of all formats are in millimetres, with the axle at the origin, azimuth 0 along x,
/// and the solid from z = 0 to its width.
struct WheelModel {
  std::string title;
  std::string program;   ///< that wrote it, e.g. "wheelwright 1.0"
  LevelSet<2> shape;     ///< from which the outline was made
  cad::Outline outline;  ///< [m]
  double width;          ///< [m]
  double tolerance;      ///< of chords and cubics that replace curves a format does not support [m]
};

/// A wheel whose shape changes along the axle: a closed surface. Placed in files like the solid of a
/// WheelModel.
struct SurfaceModel {
  std::string title;
  std::string program;
  LevelSet<3> shape;    ///< from which the surface was made
  SurfaceMesh surface;  ///< [m]
  int parts;            ///< into which each cell was divided along each axis for the surface
  int map_degree;       ///< of its isoparametric cells
};

/// Either of them, for programs that support only triangles.
struct SolidModel {
  std::string title;
  std::string program;
  SolidMesh mesh;
};

/// All formats write millimetres.
inline constexpr double millimetres_per_metre = 1e3;

}  // namespace wheelwright
