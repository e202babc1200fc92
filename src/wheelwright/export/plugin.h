#pragma once

#include <stdexcept>
#include <string>

#include "wheelwright/export/wheel_model.h"

namespace wheelwright {

/// A writer needs libraries that are not installed.
class MissingPlugin : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a plugin has under the name `plugin_symbol`: it appends a file of its format to `bytes`, or throws.
using PluginWriter = void(const WheelModel& wheel, std::string& bytes);
inline constexpr const char* plugin_symbol = "wheelwright_plugin_file";

/// The file that a plugin makes of a wheel. Plugins are shared modules, wheelwright-plugins/NAME.so beside
/// the library. A plugin and its libraries are loaded only here. Throws MissingPlugin if they cannot be
/// loaded.
std::string plugin_file(const std::string& name, const WheelModel& wheel);

}  // namespace wheelwright
