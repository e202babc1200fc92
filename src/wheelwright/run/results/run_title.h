#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The title in the pictures of a run: that of the case, or else the name of the case's output folder.
std::string run_title(const Case& c);

}  // namespace wheelwright
