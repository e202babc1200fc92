#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "wheelwright/base/expected.h"
#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// The failure not_finite, with the place of the first NaN or infinity among the values of a lattice's nodes;
/// nothing when all are finite. `what`: the values, as a subject, e.g. "the velocity".
template <int dim>
std::optional<Failure> check_finite(const Lattice<dim>& lattice, std::span<const double> values,
                                    std::string_view what);

}  // namespace wheelwright
