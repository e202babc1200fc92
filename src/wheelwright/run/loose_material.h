#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The pieces of material of a case's initial shape that nothing connects with the rim, each with its place
/// and size; a wheel with them cannot be computed.
std::vector<std::string> loose_material(const Case& c);

}  // namespace wheelwright
