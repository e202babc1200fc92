#pragma once

#include <string>

#include "wheelwright/drawing/sheet.h"

namespace wheelwright {

/// Reads the outlines of an SVG file: paths, rectangles, circles, ellipses, polygons, polylines and lines,
/// with all transforms, also through `use`. What is hidden is left out, and so are strokes' widths and
/// colours.
Sheet read_svg(const std::string& bytes);

}  // namespace wheelwright
