#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wheelwright/export/wheel_model.h"

namespace wheelwright {

/// A format that a wheel can be exported to.
struct ExportFormat {
  std::string_view name;                   ///< also the ending of its files
  std::string_view meaning;                ///< a few words
  std::string (*file)(const WheelModel&);  ///< its bytes; throws MissingPlugin and std::runtime_error
};

std::span<const ExportFormat> export_formats();

/// The format of this name; null if there is none.
const ExportFormat* find_export_format(std::string_view name);

}  // namespace wheelwright
