#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The pieces of material of a case's initial shape that are not connected to the rim, with place and size; a
/// wheel with such pieces cannot be computed.
std::vector<std::string> loose_material(const Case& c);

}  // namespace wheelwright
