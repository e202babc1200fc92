#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/outline/check_profile.h"
#include "wheelwright/case/case.h"
#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// A body of revolution for CAD and the workshop, with its layers if the case has several materials.
struct FittedTurnedWheel {
  TurnedModel model;
  cad::ProfileReport report;
};

/// `shape` must be the same about the axle (is_invariant()). The profile lies within `tolerance` [m] of its
/// edges. Refused with the faults of the profile, or of that of a layer.
Expected<FittedTurnedWheel, std::vector<cad::OutlineFault>> fitted_turned_wheel(const Case& c,
                                                                                const LevelSet<3>& shape,
                                                                                std::string title,
                                                                                double tolerance);

}  // namespace wheelwright
