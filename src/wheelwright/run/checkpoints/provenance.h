#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/run/checkpoints/checkpoint.h"

namespace wheelwright {

/// The version of the program, its commit and its compiler, as one line.
std::string program_text();

/// Everything that a run of the case depends on, except title, output, expectations and keys that only end a
/// run (optimizer.iterations and tolerance): these may change before a run is resumed.
Provenance provenance(const Case& c);

}  // namespace wheelwright
