#pragma once

#include <span>
#include <string>
#include <vector>

#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/shape/geometry/zero_set.h"

namespace wheelwright::cad {

// Parts of the checks of an outline against a zero set. Each adds the faults that it finds.

using Faults = std::vector<OutlineFault>;

/// Describes a point of the plane of an outline.
using PlaceText = std::string (*)(const Vec<2>&);

/// Every curve must start where the previous one ends, to within `slack` [m].
void check_closed(const Outline& outline, double slack, PlaceText place, Faults& faults);

/// The material must be on the left of a curve, at a distance that is larger than the tolerance.
void check_side(LoopKind kind, const Curve& curve, const ZeroSet& zero, double tolerance, PlaceText place,
                Faults& faults);

/// Loops, as polygons, must not cross or touch themselves or each other.
void check_crossings(const std::vector<std::vector<Vec<2>>>& polygons, PlaceText place, Faults& faults);

/// The largest distance of some points.
struct Deviation {
  double distance = 0;  ///< [m]
  Vec<2> place{};

  void include(double d, const Vec<2>& p) {
    if (d <= distance) return;
    distance = d;
    place = p;
  }
  void include(const Deviation& other) { include(other.distance, other.place); }
};

/// That of the points of a curve from the zero set; infinite for a point from which it is not found.
Deviation deviation_of(const Curve& curve, const ZeroSet& zero);

/// That of points from polygons, on whose sides points are at most `step` [m] apart.
Deviation deviation_of(std::span<const Vec<2>> points, const std::vector<std::vector<Vec<2>>>& polygons,
                       double step);

/// A deviation must be at most `tolerance` [m].
void check_deviation(const Deviation& deviation, double tolerance, PlaceText place, Faults& faults);

}  // namespace wheelwright::cad
