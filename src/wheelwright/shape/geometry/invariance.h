#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Motions that leave a shape as it is: those along the axle, of an extruded wheel, or all turns about it, of
/// a body of revolution.
enum class Invariance { none, along_axle, about_axle };

/// Nodal values averaged over the nodes that such motions map to each other. Along the axle every node counts
/// with its share of the width.
template <int dim>
std::vector<double> invariant_part(const Lattice<dim>& lattice, std::span<const double> values,
                                   Invariance invariance);

template <int dim>
LevelSet<dim> invariant_part(LevelSet<dim> psi, Invariance invariance) {
  if (invariance == Invariance::none) return psi;
  return {psi.lattice, invariant_part<dim>(psi.lattice, psi.values, invariance)};
}

/// Whether a shape has it, up to 1e-9 of the resolution of the grid. False if a value is NaN.
template <int dim>
bool is_invariant(const LevelSet<dim>& psi, Invariance invariance);

/// The load on the nodes that acts on invariant fields as the given one, and whose representative is
/// invariant: every node takes its share of the sum over its line.
template <int dim>
std::vector<double> invariant_load(const Lattice<dim>& lattice, std::span<const double> load,
                                   Invariance invariance);

}  // namespace wheelwright
