#pragma once

#include <string>

#include "wheelwright/export/wheel_model.h"

namespace wheelwright {

/// The material as cells for ParaView with the level set at their points, both in millimetres; not the
/// outline's curves, but the shape as it was computed.
std::string vtu_shape(const WheelModel& wheel);
std::string vtu_shape(const SurfaceModel& wheel);

/// The surface for ParaView, in millimetres.
std::string vtp_surface(const SurfaceModel& wheel);

}  // namespace wheelwright
