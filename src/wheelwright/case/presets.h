#pragma once

#include <span>
#include <string_view>

namespace wheelwright {

/// A wheel to start from.
struct Preset {
  std::string_view name;     ///< e.g. "bicycle"
  std::string_view meaning;  ///< one line
  std::string_view text;     ///< the case file
};

/// All presets, in the order in which they are listed.
std::span<const Preset> presets();

/// The preset of that name, or null.
const Preset* find_preset(std::string_view name);

}  // namespace wheelwright
