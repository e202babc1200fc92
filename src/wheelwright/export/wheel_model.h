#pragma once

#include <string>

#include "wheelwright/cad/outline.h"
#include "wheelwright/report/solid_mesh.h"

namespace wheelwright {

/// A plane wheel as CAD and workshop programs see it: an outline and the solid that it makes when it is
/// extruded along the axle. Files of all formats hold millimetres, with the axle at the origin, azimuth 0
/// along x, and the solid from z = 0 to its width.
struct WheelModel {
  std::string title;
  std::string program;   ///< what wrote it, e.g. "wheelwright 1.0"
  LevelSet<2> shape;     ///< of which the outline was made
  cad::Outline outline;  ///< [m]
  double width;          ///< [m]
  double tolerance;      ///< of chords and cubics that replace curves which a format does not have [m]
};

/// A wheel whose shape changes along the axle: a closed surface. In files it lies as the solid of a
/// WheelModel does.
struct SurfaceModel {
  std::string title;
  std::string program;
  LevelSet<3> shape;    ///< of which the surface was made
  SurfaceMesh surface;  ///< [m]
  int parts;            ///< of every cell along each axis, that the surface was made with
  int map_degree;       ///< of its isoparametric cells
};

/// What either of them is for programs that know triangles alone.
struct SolidModel {
  std::string title;
  std::string program;
  SolidMesh mesh;
};

/// All formats write millimetres.
inline constexpr double millimetres_per_metre = 1e3;

}  // namespace wheelwright
