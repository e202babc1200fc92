#pragma once

#include <vector>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// An edge of the material other than rim and tread: a closed polyline in whole micrometres (Cartesian, body
/// frame), x and y alternating.
struct OutlineLoop {
  bool is_in_every_sector;  ///< represents its images in all sectors; otherwise it is unique
  std::vector<int> micrometres;
};

/// The edges of a shape, one per set of images.
std::vector<OutlineLoop> sector_outline(const LevelSet<2>& psi);

}  // namespace wheelwright
