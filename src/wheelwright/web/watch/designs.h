#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/web/watch/products.h"

namespace wheelwright {

/// The designs of an exploration or a sweep, for a page that offers their shapes. Names from a page are
/// looked up only here.
struct OfferedDesigns {
  std::string json = R"({"quantities":[],"designs":[]})";  ///< for the page
  std::map<std::string, std::filesystem::path> shapes;     ///< by the designs' names
};

/// The designs with a saved shape in the folder of an exploration or a sweep; or why there are none.
Expected<OfferedDesigns, NoProduct> offered_designs(const std::filesystem::path& folder);

}  // namespace wheelwright
