#pragma once

#include <stdexcept>
#include <string>
#include <variant>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// A wheel as a solid: of extrusion or of revolution, with exact faces, or with lofted ones or facets. Refers
/// to its model.
using StepModel = std::variant<const WheelModel*, const TurnedModel*, const FacesModel*>;

/// A writer needs libraries that are not installed.
class MissingPlugin : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Faces that do not make a valid solid.
class InvalidSolid : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The function that a plugin exports as `plugin_symbol`: appends a file of its format to `bytes`, or throws.
/// The type of its model depends on the plugin: step takes a StepModel, 3mf a SolidModel.
template <class Model>
using PluginWriter = void(const Model& model, std::string& bytes);
inline constexpr const char* plugin_symbol = "wheelwright_plugin_file";

/// The address of a plugin's writer. `development_package`: the Debian package with the libraries that it
/// needs to build.
void* plugin_writer(const std::string& name, const std::string& development_package);

/// The file that a plugin writes of its model. Plugins are shared modules, wheelwright-plugins/NAME.so next
/// to the library. A plugin and its libraries are loaded only here. Throws MissingPlugin if they cannot be
/// loaded.
template <class Model>
std::string plugin_file(const std::string& name, const std::string& development_package, const Model& model) {
  std::string bytes;
  reinterpret_cast<PluginWriter<Model>*>(plugin_writer(name, development_package))(model, bytes);
  return bytes;
}

}  // namespace wheelwright
