#pragma once

#include <vector>

#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/zero_contour.h"

namespace wheelwright::cad {

/// A closed contour as points on {psi = 0}, at most a given distance apart.
struct ContourSamples {
  std::vector<Vec<2>> points;
  /// Angle by which the direction of the contour jumps at each point [rad]: other than zero only where the
  /// contour passes from one cell to another.
  std::vector<double> kinks;
};

/// Refines a free contour of material_contours(): its points lie on the zero contour, those between them are
/// projected onto it.
ContourSamples sample(const Contour& contour, const ZeroContour& zero, double distance);

}  // namespace wheelwright::cad
