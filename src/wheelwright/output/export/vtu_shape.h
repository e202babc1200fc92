#pragma once

#include <string>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// The material as cells for ParaView with the level set at their points, both in millimetres: the shape as
/// computed, not the curves of the outline.
std::string vtu_shape(const WheelModel& wheel);
std::string vtu_shape(const SurfaceModel& wheel);

/// The surface for ParaView, in millimetres.
std::string vtp_surface(const SurfaceModel& wheel);

}  // namespace wheelwright
