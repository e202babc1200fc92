#pragma once

#include <optional>

#include "wheelwright/mechanics/state/load_case.h"
#include "wheelwright/mechanics/state/ring_field.h"

namespace wheelwright {

/// The fatigue utilization of a turn at the nodes of displacement_lattice(), the same in all sectors: the
/// mean over the cells with material around a node, of one layer. Nothing unless all positions were solved
/// and the fatigue strength of every material is known.
template <int dim>
std::optional<NamedField> fatigue_field(const StateSolver<dim>& solver, const State<dim>& state);

/// The same of the equivalent utilization under all load cases (mechanics/elasticity/miners_rule.h), if their
/// shares of the distance and the life of every material are known, and all of them can be solved; else under
/// the first one, whose state is given.
template <int dim>
std::optional<NamedField> fatigue_field(const StateSolver<dim>& solver, const State<dim>& first,
                                        const LoadCases<dim>& cases);

}  // namespace wheelwright
