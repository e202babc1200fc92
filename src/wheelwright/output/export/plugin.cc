#include "wheelwright/output/export/plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

namespace wheelwright {
namespace {

/// The folder of the library that contains this code.
std::filesystem::path library_folder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<void*>(&plugin_writer), &info) == 0 || info.dli_fname == nullptr) return ".";
  return std::filesystem::absolute(info.dli_fname).parent_path();
}

}  // namespace

void* plugin_writer(const std::string& name, const std::string& development_package) {
  const std::filesystem::path file = library_folder() / "wheelwright-plugins" / (name + ".so");
  // Never closed: the libraries of a plugin may have registered handlers that run at exit.
  void* plugin = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  std::error_code ignored;
  if (plugin == nullptr && !std::filesystem::exists(file, ignored))
    throw MissingPlugin(
        fmt::format("its writer is not installed: install the package wheelwright-cad; if the program was "
                    "built from source, install {} and rebuild",
                    development_package));
  if (plugin == nullptr)
    throw MissingPlugin(
        fmt::format("a library of its writer is missing: install the package wheelwright-cad, or {}: {}",
                    development_package, dlerror()));
  void* writer = dlsym(plugin, plugin_symbol);
  if (writer == nullptr) throw MissingPlugin(fmt::format("{} is not a writer", file.string()));
  return writer;
}

}  // namespace wheelwright
