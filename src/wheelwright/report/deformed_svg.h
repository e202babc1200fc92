#pragma once

#include <optional>
#include <string>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/state/ring_field.h"

namespace wheelwright {

/// The deformed wheel under one load position, coloured by a scalar.
struct DeformedPicture {
  std::string title;
  RingField displacement;  ///< 2 components [m]
  double magnification;    ///< of the displacement in the picture
  double contact_azimuth;  ///< azimuth of the contact point in the body frame [rad]: drawn at the bottom
  /// Half the edge of a square view of the contact [m]; absent: the whole wheel.
  std::optional<double> window;
  NamedField scalar;  ///< 1 component, in an SI unit without prefix, e.g. "von Mises stress" in "Pa"
  double outliers;    ///< fraction of the drawn pieces that the colours leave out at each end of their range
};

/// The picture as an SVG document with a colour bar; neighbours of one colour are drawn as one. `lattice`
/// carries the fields, on psi's grid.
std::string deformed_svg(const LevelSet<2>& psi, const Lattice<2>& lattice, const DeformedPicture& picture);

}  // namespace wheelwright
