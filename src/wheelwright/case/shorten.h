#pragma once

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The case with another number of shapes. If it differs from the case's own, what is expected of later
/// shapes, or of the last one, is left out.
Case with_iterations(Case c, int iterations);

}  // namespace wheelwright
