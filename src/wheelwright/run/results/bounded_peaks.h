#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// At how many load positions the bounds on peaks apply, as a sentence; empty if the case bounds no peak, nor
/// anything in its worst position or in each one.
std::string bounded_peaks(const Case& c);

}  // namespace wheelwright
