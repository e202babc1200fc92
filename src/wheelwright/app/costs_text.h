#pragma once

#include <string>

#include "wheelwright/design/explore/plan.h"

namespace wheelwright {

/// What the designs of a plan will cost in memory and time on so many threads, in lines that end with '\n'.
/// Empty if there are no designs.
std::string costs_text(const DesignPlan& plan, int threads, bool wants_finalists);

}  // namespace wheelwright
