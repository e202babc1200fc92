#pragma once

#include <string>
#include <variant>
#include <vector>

#include "wheelwright/drawing/outline.h"

namespace wheelwright {

/// Curves in a row whose neighbours have the same ends up to rounding, as a loop that is closed exactly.
/// Curves without length are left out, and a line closes a gap between the last and the first.
Loop closed_loop(const std::vector<Curve>& curves, std::string place);

/// Curves drawn one by one, and where each comes from.
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

/// What loose curves form when their ends are joined.
struct Chains {
  std::vector<Loop> loops;
  std::vector<OpenEnd> open_ends;
};

/// Joins the curves, in any order and direction, at ends that are at most `tolerance` apart.
Chains chained(const std::vector<LooseCurve>& curves, double tolerance);

}  // namespace wheelwright
