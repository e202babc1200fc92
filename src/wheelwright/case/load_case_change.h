#pragma once

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Whether a load case can have this load under the section `load`: load cases share the lateral force, the
/// camber and the load positions.
bool is_load_of_a_case(const Load& section, const Load& load);

/// The load case changed to have another load under the section `load`.
CaseLoad changed_load_case(CaseLoad load_case, const Load& section, const Load& load);

}  // namespace wheelwright
