#pragma once

#include <vector>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// An edge of the material besides rim and tread: a closed polyline in whole micrometres (Cartesian, body
/// frame), x and y in turn.
struct OutlineLoop {
  bool is_in_every_sector;  ///< it stands for its images in all sectors; else it is the only one
  std::vector<int> micrometres;
};

/// The edges of a shape, one of each set of images.
std::vector<OutlineLoop> sector_outline(const LevelSet<2>& psi);

}  // namespace wheelwright
