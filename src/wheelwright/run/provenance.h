#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/run/checkpoint.h"

namespace wheelwright {

/// Version of the program, its compiler and its libraries, one line.
std::string program_text();

/// What a run of the case depends on. Title, output, expectations and what only ends a run
/// (optimizer.iterations and tolerance) are left out: they may change before a run goes on.
Provenance provenance(const Case& c);

}  // namespace wheelwright
