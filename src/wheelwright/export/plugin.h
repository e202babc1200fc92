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
/// What it takes as a model is its own: step a WheelModel, 3mf a SolidModel.
template <class Model>
using PluginWriter = void(const Model& model, std::string& bytes);
inline constexpr const char* plugin_symbol = "wheelwright_plugin_file";

/// The address of a plugin's writer. `development_package`: of Debian, with the libraries that it is built
/// with.
void* plugin_writer(const std::string& name, const std::string& development_package);

/// The file that a plugin makes of its model. Plugins are shared modules, wheelwright-plugins/NAME.so beside
/// the library. A plugin and its libraries are loaded only here. Throws MissingPlugin if they cannot be
/// loaded.
template <class Model>
std::string plugin_file(const std::string& name, const std::string& development_package, const Model& model) {
  std::string bytes;
  reinterpret_cast<PluginWriter<Model>*>(plugin_writer(name, development_package))(model, bytes);
  return bytes;
}

}  // namespace wheelwright
