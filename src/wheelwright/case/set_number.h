#pragma once

#include <optional>
#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Gives a key of a case, such as "load.mass" or "holes.ring[2].radius", another number, in the unit of the
/// case file. Returns what is wrong, one line, and changes nothing then: no such key, no number, or out of
/// the key's range. Whether the case as a whole is valid is not checked.
std::optional<std::string> set_number(Case& c, const std::string& path, double value);

}  // namespace wheelwright
