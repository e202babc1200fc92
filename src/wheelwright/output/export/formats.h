#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// A format that a wheel can be exported to.
struct ExportFormat {
  std::string_view name;     ///< also the extension of its files
  std::string_view meaning;  ///< a few words
  /// The file contents for a plane wheel, for the surface of one whose shape changes along the axle, for the
  /// same as a solid with faces, and for the profile of a body of revolution; null if the format cannot
  /// represent it. They throw MissingPlugin and std::runtime_error.
  std::string (*of_plane)(const WheelModel&);
  std::string (*of_surface)(const SurfaceModel&);
  std::string (*of_faces)(const FacesModel&);
  std::string (*of_profile)(const TurnedModel&);
};

std::span<const ExportFormat> export_formats();

/// The format of this name, or null.
const ExportFormat* find_export_format(std::string_view name);

}  // namespace wheelwright
