#pragma once

#include <string>

#include "wheelwright/optimize/optimizer.h"

namespace wheelwright {

/// Why a run ended, for people, e.g. "converged"; to_string() is for programs.
std::string text(StopReason reason);

/// The same where the reason is known by its name for programs; any other text stays as it is.
std::string text_of_stop(const std::string& name);

}  // namespace wheelwright
