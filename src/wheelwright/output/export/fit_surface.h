#pragma once

#include <array>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/output/export/wheel_model.h"
#include "wheelwright/shape/surface/check_surface.h"

namespace wheelwright {

/// A surface within a tolerance, and its measurements.
struct FittedSurface {
  SurfaceMesh surface;
  int parts;             ///< of every cell along each axis
  SurfaceReport report;  ///< of the numbers as written to files; volume in mm^3
  double deviation;      ///< of the holes from {psi = 0} [m]
  Vec<3> place;          ///< where that is: (radius, azimuth, axial)
  double volume_error;   ///< relative, against the level set's volume
};

/// Why there is no surface, in a sentence.
struct SurfaceRefusal {
  std::string what;
};

/// Into how many cubes along each axis a cell can be divided for a surface.
inline constexpr std::array divisions_of_cell{1, 2, 3, 4, 6, 8};

/// The surface of a shape with the fewest cubes per cell, at most 8 along each axis, that keep the surface of
/// the holes within `tolerance` [m] of {psi = 0}, on isoparametric cells of degree `map_degree`, and its
/// volume within 0.1 % of the level set's, also where rim and tread are curved and there are no holes.
/// Refused if no number suffices, if the surface does not bound a solid, or if there is no material.
Expected<FittedSurface, SurfaceRefusal> fit_surface(const LevelSet<3>& psi, int map_degree, double tolerance);

/// Tells users what to do about a surface that deviates by more than the tolerance. `deviation` [m].
std::string advice_on_tolerance(double deviation);

/// As readable lines.
std::string text(const FittedSurface& surface);

}  // namespace wheelwright
