#pragma once

#include <cmath>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// A square part of the plane of a loaded wheel, drawn as a square of pixels. Picture coordinates: origin at
/// the axle of the undeformed wheel, x along the ground towards larger azimuth, y towards the ground [m].
struct PictureView {
  Vec<2> centre;
  double half;       ///< half of its edge [m]
  double left, top;  ///< of the square [pixels]
  double size;       ///< of its edge [pixels]

  double pixels_per_metre() const { return 0.5 * size / half; }
  Vec<2> pixel(const Vec<2>& x) const {
    return {left + 0.5 * size + (x[0] - centre[0]) * pixels_per_metre(),
            top + 0.5 * size + (x[1] - centre[1]) * pixels_per_metre()};
  }
  bool holds(const Vec<2>& x) const {
    return std::abs(x[0] - centre[0]) <= half && std::abs(x[1] - centre[1]) <= half;
  }
};

}  // namespace wheelwright
