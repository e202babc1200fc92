#pragma once

#include <string>

#include "wheelwright/optimization/optimizer/optimizer.h"

namespace wheelwright {

/// Why a run ended, as readable text, e.g. "ended, no step gives a better shape"; to_string() is for
/// programs.
std::string text(StopReason reason);

/// The same for a reason given by its to_string(); any other text is returned unchanged.
std::string text_of_stop(const std::string& name);

}  // namespace wheelwright
