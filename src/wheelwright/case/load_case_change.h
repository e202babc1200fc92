#pragma once

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Whether one load case can be this load beside others under the section `load`: load cases share the
/// lateral force, the camber and the load positions.
bool is_load_of_a_case(const Load& section, const Load& load);

/// The load case whose load, under the section `load`, is another one.
CaseLoad changed_load_case(CaseLoad load_case, const Load& section, const Load& load);

}  // namespace wheelwright
