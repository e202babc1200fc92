#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/cad/drawing/chain.h"
#include "wheelwright/cad/drawing/drawing.h"

namespace wheelwright {

/// The contents of a file of curves, in the file's own unit and axes.
struct Sheet {
  std::vector<DrawnLoop> loops;
  std::vector<LooseCurve> loose;          ///< which may form more loops
  std::optional<double> metres_per_unit;  ///< if the file says it
  bool y_points_down = false;
  std::optional<Point> axle;  ///< the axle's place unless given by the case: the page's centre, or the origin
  std::vector<DrawingProblem> problems;
};

/// More problems of one file are not listed.
inline constexpr std::size_t most_problems = 30;

/// Drawings of more curves are refused.
inline constexpr std::size_t most_curves_of_a_sheet = 100'000;

/// "at [3, 4]", in the drawing's own unit.
std::string at_text(const Point& p);

/// A name from a file for messages: one line, and not long.
std::string shown(std::string_view name);

/// All loops of a sheet; what stays open or empty is added to its problems, and coordinates that are no
/// numbers or too large.
std::vector<DrawnLoop> closed_loops(Sheet& sheet);

}  // namespace wheelwright
