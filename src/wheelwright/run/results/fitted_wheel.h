#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/outline/check_outline.h"
#include "wheelwright/case/case.h"
#include "wheelwright/output/export/fit_surface.h"
#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

// A shape of a case for CAD and the workshop, with its layers if the case has several materials: what
// export_formats() write.

struct FittedWheel {
  WheelModel model;
  cad::OutlineReport report;
};

/// The outline lies within `tolerance` [m] of the shape's edges. Refused with all faults of the outline and
/// of its division into layers.
Expected<FittedWheel, std::vector<cad::OutlineFault>> fitted_wheel(const Case& c, const LevelSet<2>& shape,
                                                                   std::string title, double tolerance);

struct FittedSolidWheel {
  SurfaceModel model;
  FittedSurface whole;
};

/// The surface of the holes lies within `tolerance` [m] of them. Refused as fit_surface() does.
Expected<FittedSolidWheel, std::vector<cad::OutlineFault>> fitted_wheel(const Case& c,
                                                                        const LevelSet<3>& shape,
                                                                        std::string title, double tolerance);

}  // namespace wheelwright
