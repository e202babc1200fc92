#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/drawing/curve_tree.h"

namespace wheelwright {

/// A closed chain of curves: each starts where the previous one ends, and the first where the last one ends.
struct DrawnLoop {
  std::vector<Curve> curves;
  std::string place;  ///< where it comes from, for messages, e.g. "line 12, <path id=\"a\">"; may be empty
};

/// The plane region inside an odd number of its loops (even-odd rule) [m].
struct DrawnOutline {
  std::vector<DrawnLoop> loops;

  DrawnOutline mapped(const Affine& map) const;
};

/// A place where the loops of an outline cross, touch or lie on each other.
struct Crossing {
  Point at;
  std::string first, second;  ///< places of the two loops; equal if a loop crosses itself
};

/// Places where the loops of an outline meet, at most `most` of them.
std::vector<Crossing> crossings(const DrawnOutline& outline, int most);

/// The distances from the axle between which a curve lies [m].
struct RadialExtent {
  double low, high;
  Point lowest, highest;  ///< where
};
RadialExtent radial_extent(const Curve& curve);

/// The smallest rectangle that contains the outline, or a slightly larger one.
Box box(const DrawnOutline& outline);

}  // namespace wheelwright
