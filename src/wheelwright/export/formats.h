#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wheelwright/export/wheel_model.h"

namespace wheelwright {

/// A format that a wheel can be exported to.
struct ExportFormat {
  std::string_view name;     ///< also the ending of its files
  std::string_view meaning;  ///< a few words
  /// The bytes of the file of a plane wheel, and of one whose shape changes along the axle; null where the
  /// format cannot hold it. They throw MissingPlugin and std::runtime_error.
  std::string (*of_plane)(const WheelModel&);
  std::string (*of_surface)(const SurfaceModel&);
};

std::span<const ExportFormat> export_formats();

/// The format of this name; null if there is none.
const ExportFormat* find_export_format(std::string_view name);

}  // namespace wheelwright
