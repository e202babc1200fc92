#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// A wheel in 3D as a solid with faces, and what it is worth.
struct FittedFacesWheel {
  FacesModel model;
  std::string why_facets;  ///< why the wheel has facets instead of smooth faces; empty if it has smooth ones
  double volume;           ///< [m^3]
  double volume_error;     ///< relative, against the volume of the fine surface with exact cylinders
  double deviation;        ///< the largest of the faces of holes from {psi = 0} [m]
  Vec<3> place;            ///< where that is: (radius, azimuth, axial)
};

enum class FaceKind {
  smooth,  ///< where that is possible, otherwise facets
  facets,
};

/// The faces of a wheel and of its layers, within `tolerance` [m] of {psi = 0} in holes. Refused with the
/// place if one of the surfaces is not that of a solid.
Expected<FittedFacesWheel, std::vector<cad::OutlineFault>> fitted_faces_wheel(const SurfaceModel& wheel,
                                                                              FaceKind kind,
                                                                              double tolerance);

/// As readable lines.
std::string text(const FittedFacesWheel& wheel);

}  // namespace wheelwright
