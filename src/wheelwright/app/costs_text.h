#pragma once

#include <string>

#include "wheelwright/design/explore/plan.h"

namespace wheelwright {

/// Says how much memory and time the designs of a plan need on so many threads, in lines that end with '\n'.
/// Empty if there are no designs.
std::string costs_text(const DesignPlan& plan, int threads, bool wants_finalists);

}  // namespace wheelwright
