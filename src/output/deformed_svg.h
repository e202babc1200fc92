#pragma once

#include <string>

#include "geometry/level_set.h"
#include "output/ring_field.h"

namespace wheelwright {

/// The deformed wheel under one load position, coloured by a scalar.
struct DeformedPicture {
  std::string title;
  RingField displacement;  ///< 2 components [m]
  double magnification;    ///< of the displacement in the picture
  double contact_azimuth;  ///< azimuth of the contact point in the body frame [rad]: drawn at the bottom
  NamedField scalar;       ///< 1 component, in an SI unit without prefix, e.g. "von Mises stress" in "Pa"
};

/// The picture as an SVG document with a colour bar. Colours span the 1st to the 99th percentile of the drawn
/// pieces. `lattice` carries the fields, on psi's grid.
std::string deformed_svg(const LevelSet<2>& psi, const Lattice<2>& lattice, const DeformedPicture& picture);

}  // namespace wheelwright
