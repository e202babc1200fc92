#pragma once

#include <optional>
#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Gives a key of a case, such as "load.mass" or "holes.ring[2].radius", another number, in this unit, or in
/// that of the case file if it is empty. Returns what is wrong, one line, and changes nothing then: no such
/// key, no number, no unit of it, or out of the key's range. Whether the case as a whole is valid is not
/// checked.
std::optional<std::string> set_number(Case& c, const std::string& path, double value,
                                      const std::string& unit = "");

}  // namespace wheelwright
