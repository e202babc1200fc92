#pragma once

#include <string>
#include <variant>
#include <vector>

#include "wheelwright/cad/drawing/drawn_outline.h"

namespace wheelwright {

/// Curves in a row whose neighbours have the same ends up to rounding, as a loop that is closed exactly.
/// Curves without length are left out, and a line closes a gap between the last and the first.
DrawnLoop closed_loop(const std::vector<Curve>& curves, std::string place);

/// Individually drawn curves, each with its origin in the file.
struct LooseCurve {
  Curve curve;
  std::string place;
};

/// An end of a chain that meets no other end, or several of them.
struct OpenEnd {
  Point at;
  std::string place;
  bool branches;  ///< more than two curves end here
};

/// The result of joining the ends of loose curves.
struct Chains {
  std::vector<DrawnLoop> loops;
  std::vector<OpenEnd> open_ends;
};

/// Joins the curves, in any order and direction, at ends that are at most `tolerance` apart.
Chains chained(const std::vector<LooseCurve>& curves, double tolerance);

}  // namespace wheelwright
