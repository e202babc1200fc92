#pragma once

#include <optional>

#include "wheelwright/cad/outline/outline.h"

namespace wheelwright::cad {

/// A width between two places of the edges that face each other.
struct Clearance {
  double width;  ///< [m]
  Vec<2> from, to;
};

struct Clearances {
  /// The thinnest neck of material: two places of the edges whose distance across the material shrinks
  /// neither to one side nor to the other.
  std::optional<Clearance> wall;
  /// The narrowest neck of a hole or, if it is smaller, the largest circle that fits into some hole. Nothing
  /// if there are no holes.
  std::optional<Clearance> gap;
};

/// A step that misses no neck, by the tread's radius.
inline constexpr double clearance_step = 6e-4;

/// Measures an outline whose loops are repeated in every sector. Follows every edge with steps of at most
/// `step` [m], and at each finds the largest circle that touches it there on one side and contains no other
/// edge. Where such a circle also touches on its opposite side there may be a neck, whose ends are then moved
/// along the curves until their distance is least.
Clearances clearances(const Outline& outline, int n_sectors, double step);

}  // namespace wheelwright::cad
