#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/cut/bernstein.h"

namespace wheelwright {

/// The places in (0, 1) along axes[2] at which the zero set of psi in the plane across it has a critical
/// point within the unit square: a new or vanishing piece, or a crossing. Points that are not isolated are
/// omitted.
std::vector<double> critical_places(const BernsteinForm<3>& psi, const std::array<int, 3>& axes);

}  // namespace wheelwright
