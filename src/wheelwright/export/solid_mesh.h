#pragma once

#include <array>
#include <vector>

#include "wheelwright/export/wheel_model.h"

namespace wheelwright {

/// The closed surface of the solid by triangles whose normals point outwards, in millimetres. Its corners lie
/// on the curves; the chords between them deviate by at most the model's tolerance.
struct SolidMesh {
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<int, 3>> triangles;
};

SolidMesh solid_mesh(const WheelModel& wheel);

}  // namespace wheelwright
