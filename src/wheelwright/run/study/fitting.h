#pragma once

#include <optional>
#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Says how an initial shape that cannot be made as the case asks (Optimizer::made) was changed; empty for
/// others.
template <int dim>
std::optional<std::string> fitting_of_initial_shape(const Case& c);

/// Says why a shape whose material is connected came apart when it was made as the case asks, and what helps;
/// empty if it did not.
template <int dim>
std::string remedy_of_fitting(const Case& c);

}  // namespace wheelwright
