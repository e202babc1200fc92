#pragma once

#include <optional>

#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The fatigue utilization of a turn at the nodes of displacement_lattice(), the same in all sectors: the
/// mean over the cells with material around a node, of one layer. Nothing unless all positions were solved
/// and the fatigue strength of every material is known.
template <int dim>
std::optional<RingField> fatigue_field(const StateSolver<dim>& solver, const State<dim>& state);

}  // namespace wheelwright
