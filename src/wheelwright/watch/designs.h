#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/watch/products.h"

namespace wheelwright {

/// The designs of an exploration or a sweep, for a page that offers their shapes. What a page names is looked
/// up here and nowhere else.
struct OfferedDesigns {
  std::string json = R"({"quantities":[],"designs":[]})";  ///< for the page
  std::map<std::string, std::filesystem::path> shapes;     ///< by the designs' names
};

/// Those in the folder of an exploration or a sweep that have saved a shape; or why there are none.
Expected<OfferedDesigns, NoProduct> offered_designs(const std::filesystem::path& folder);

}  // namespace wheelwright
