#pragma once

#include <optional>
#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Sets a key of a case, such as "load.mass" or "holes.ring[2].radius", to a number in this unit, or in that
/// of the case file if it is empty. On errors, returns one line and changes nothing: no such key, not a
/// number, wrong unit, or out of the key's range. Does not check whether the case as a whole is valid.
std::optional<std::string> set_number(Case& c, const std::string& path, double value,
                                      const std::string& unit = "");

}  // namespace wheelwright
