#pragma once

#include <string>

#include "wheelwright/cad/drawing/sheet.h"

namespace wheelwright {

/// Reads the outlines of an SVG file: paths, rectangles, circles, ellipses, polygons, polylines and lines,
/// with all transforms, also through `use`. Hidden elements, and widths and colours of strokes, are ignored.
Sheet read_svg(const std::string& bytes);

}  // namespace wheelwright
