#pragma once

#include <string>

#include "wheelwright/cad/drawing/sheet.h"

namespace wheelwright {

/// Reads the outlines of an ASCII DXF file in its plane z = 0: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE and
/// POLYLINE with bulges, SPLINE up to degree 3, and blocks of them by INSERT. Frozen and switched-off layers,
/// the paper space, texts, dimensions, hatches and points are left out.
Sheet read_dxf(const std::string& bytes);

}  // namespace wheelwright
