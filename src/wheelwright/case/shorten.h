#pragma once

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The case with another number of shapes. If the number differs from the case's own, the expectations of
/// later shapes and of the last one are removed.
Case with_iterations(Case c, int iterations);

}  // namespace wheelwright
