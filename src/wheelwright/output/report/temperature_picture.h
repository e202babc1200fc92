#pragma once

#include <optional>

#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The steady temperature [deg C] of the rolling wheel at the nodes of displacement_lattice(), the same in
/// all sectors. Nothing unless all positions were solved and the state's model has temperatures, or if the
/// conduction cannot be solved.
template <int dim>
std::optional<RingField> temperature_picture(const StateSolver<dim>& solver, const State<dim>& state);

}  // namespace wheelwright
