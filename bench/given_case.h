#pragma once

#include <optional>
#include <span>

#include "wheelwright/case/case.h"

namespace wheelwright::bench {

/// The case of a file, in which keys are given other numbers: `changes` are arguments of the form KEY=NUMBER,
/// such as grid.radial_cells=14. Prints what is wrong and returns nothing if it cannot be read.
std::optional<Case> given_case(const char* path, std::span<char* const> changes);

}  // namespace wheelwright::bench
