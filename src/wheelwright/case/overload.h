#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Whether the load would strain a solid disc by a quarter or more, which linear elasticity cannot compute.
bool is_overloaded(const Case& c);

/// Whether a modulus [Pa] is smaller than that of any solid wheel; and the question whether MPa were meant.
bool may_be_in_megapascals(double modulus);
std::string question_of_megapascals(double modulus);

/// Whether the load would flatten a solid disc because a modulus was given in MPa, in any theory.
bool is_overloaded_in_pascals(const Case& c);

}  // namespace wheelwright
