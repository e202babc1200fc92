#pragma once

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// The solid of a plane wheel. Its corners lie on the curves; the chords between them deviate by at most the
/// model's tolerance.
SolidMesh solid_mesh(const WheelModel& wheel);

}  // namespace wheelwright
