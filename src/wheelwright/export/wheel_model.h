#pragma once

#include <string>

#include "wheelwright/cad/outline.h"

namespace wheelwright {

/// A wheel as CAD and workshop programs see it: a plane outline and the solid that it makes when it is
/// extruded along the axle. Files of all formats hold millimetres, with the axle at the origin, azimuth 0
/// along x, and the solid from z = 0 to its width.
struct WheelModel {
  std::string title;
  std::string program;  ///< what wrote it, e.g. "wheelwright 1.0"
  LevelSet<2> shape;    ///< of which the outline was made
  Outline outline;      ///< [m]
  double width;         ///< [m]
  double tolerance;     ///< of chords and cubics that replace curves which a format does not have [m]
};

/// All formats write millimetres.
inline constexpr double millimetres_per_metre = 1e3;

}  // namespace wheelwright
