#include "wheelwright/run/results/run_title.h"

#include <filesystem>

namespace wheelwright {

std::string run_title(const Case& c) {
  if (!c.title.empty()) return c.title;
  // Works with and without a trailing slash.
  return (std::filesystem::path(c.output.folder) / "").parent_path().filename().string();
}

}  // namespace wheelwright
