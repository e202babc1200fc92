#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/drawing/drawing.h"

namespace wheelwright {

/// A picture as the darkness of its pixels: 0 for white and for what is transparent, 1 for black.
struct Picture {
  std::string bytes;  ///< the whole file
  int columns = 0, rows = 0;
  std::vector<float> darkness;  ///< row by row from the top

  float at(int column, int row) const { return darkness[static_cast<std::size_t>(row) * columns + column]; }
};

/// A picture, or why it cannot be read.
struct PictureResult {
  std::optional<Picture> value;
  std::vector<DrawingProblem> problems;
};

/// Pictures with more pixels are refused.
inline constexpr long long most_pixels = 16'000'000;

/// Reads a PNG file of any colour type and depth.
PictureResult read_png(std::string bytes);

}  // namespace wheelwright
