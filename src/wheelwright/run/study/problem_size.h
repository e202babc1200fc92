#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/mechanics/rolling/cost_estimate.h"

namespace wheelwright {

/// The size of a case, from which follow the memory and the time of its run.
ProblemSize problem_size(const Case& c);

/// The same for shapes whose edges cross all faces between sectors, such as grooves around the wheel: then
/// derivatives on the faces are unknowns too.
ProblemSize problem_size_of_grooves(const Case& c);

}  // namespace wheelwright
