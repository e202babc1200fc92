#pragma once

#include <string>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// The solid as a binary STL file.
std::string stl(const SolidModel& solid);

}  // namespace wheelwright
