#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/cad/drawing/drawn_outline.h"

namespace wheelwright {

/// A problem in a drawing, with its place.
struct DrawingProblem {
  /// The key of the case that would solve it, if any.
  enum class Key { none, unit, axle };

  int line = 0;  ///< from 1; 0 if unknown
  std::string problem;
  std::string remedy;
  Key key = Key::none;
};

/// Options for reading a file of curves.
struct DrawingOptions {
  std::optional<double> metres_per_unit;  ///< absent: as the file says
  std::optional<Point> axle;              ///< in the file's own unit and axes; absent: the usual place
};

/// The contents of a file: the axle at the origin, x to the right as in the drawing and y upwards.
struct Drawing {
  std::string bytes;     ///< the whole file
  DrawnOutline outline;  ///< [m]
  double metres_per_unit = 1;
  Point axle{};  ///< the assumed place of the axle, in the file's own unit and axes
};

/// A drawing, or all of its problems.
struct DrawingResult {
  std::optional<Drawing> value;
  std::vector<DrawingProblem> problems;
};

/// Larger files are refused.
inline constexpr std::size_t most_drawing_bytes = std::size_t{1} << 25;

enum class DrawingFormat { svg, dxf };

/// The format by the end of a file's name; nothing if it is none of them.
std::optional<DrawingFormat> drawing_format(const std::string& file_name);

DrawingResult read_drawing(DrawingFormat format, std::string bytes, const DrawingOptions& options);

}  // namespace wheelwright
