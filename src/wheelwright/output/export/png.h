#pragma once

#include <string>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// A picture of the wheel as a PNG file: the material in blue on white, 1600 pixels wide.
std::string png(const WheelModel& wheel);

/// The same size of picture of a surface, lit.
std::string png(const SurfaceModel& wheel);

}  // namespace wheelwright
