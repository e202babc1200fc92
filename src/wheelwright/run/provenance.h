#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/run/checkpoint.h"

namespace wheelwright {

/// The version of the program, its commit and its compiler, as one line.
std::string program_text();

/// What a run of the case depends on. Title, output, expectations and keys that only end a run
/// (optimizer.iterations and tolerance) are left out: they may change before a run is resumed.
Provenance provenance(const Case& c);

}  // namespace wheelwright
