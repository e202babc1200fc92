#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/base/expected.h"

namespace wheelwright {

/// Why a text is no list of points.
struct PointsError {
  int line;  ///< from 1
  std::string problem;
};

/// The points of a CSV file: two numbers per line between commas, semicolons, tabs or spaces. Between
/// semicolons and tabs the numbers may have decimal commas. Empty lines, lines that begin with # and a first
/// line of words are ignored.
Expected<std::vector<std::array<double, 2>>, PointsError> parse_points(std::string_view text);

}  // namespace wheelwright
