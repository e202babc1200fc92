#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Returns the failure not_finite, with the place of the first NaN or infinity, unless all nodal values are
/// finite. `what` names the values in the message, e.g. "the velocity".
template <int dim>
std::optional<Failure> check_finite(const Lattice<dim>& lattice, std::span<const double> values,
                                    std::string_view what);

}  // namespace wheelwright
