#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/geometry/zero_set.h"

namespace wheelwright::cad {

/// A contour as points on {psi = 0}, at most a given distance apart.
struct ContourSamples {
  std::vector<Vec<2>> points;
  /// Angle by which the direction of the contour jumps at each point [rad]: other than zero only where the
  /// contour passes from one cell to another.
  std::vector<double> kinks;
};

/// Refines a closed polyline whose points lie on the zero set: those between them are projected onto it.
ContourSamples sample_closed(std::span<const Vec<2>> points, const ZeroSet& zero, double distance);

/// The same from the first point to the last, at which there is no kink.
ContourSamples sample_open(std::span<const Vec<2>> points, const ZeroSet& zero, double distance);

}  // namespace wheelwright::cad
