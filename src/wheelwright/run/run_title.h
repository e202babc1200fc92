#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// What the pictures of a run are called: the case's title, or else the name of the folder that it gives.
std::string run_title(const Case& c);

}  // namespace wheelwright
