#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {

/// A free contour that stands for its images in all sectors, or one about the axle, which is its own image.
struct RepresentativeContour {
  const Contour* contour;
  bool is_about_axle;
};

/// The free contours of a shape that is the same in every sector: the first of each group of images. They
/// refer to `contours`.
std::vector<RepresentativeContour> representatives(std::span<const Contour> contours,
                                                   const PolarGrid<2>& grid);

}  // namespace wheelwright
