#pragma once

#include <string>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// The outline as a DXF drawing (AC1015, AutoCAD 2000) in millimetres. Each kind of loop has its own layer:
/// OUTER_EDGE, BORE, HOLE, ISLAND. A circle is a CIRCLE; a loop of lines and arcs is a closed LWPOLYLINE with
/// bulges; in other loops every curve is a LINE, an ARC or a SPLINE of degree 3.
std::string dxf(const WheelModel& wheel);

/// The profile in the same way, with the axle as a centre line in the layer AXLE.
std::string dxf(const TurnedModel& wheel);

}  // namespace wheelwright
