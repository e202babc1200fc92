#pragma once

#include <vector>

#include "wheelwright/optimization/optimizer/optimization_state.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {

/// A state whose shape was transferred to another grid; its evaluation is still that of the original shape.
template <int dim>
struct OnOtherGrid {
  OptimizationState<dim> state;
  std::vector<ShapeEvent<dim>> events;  ///< changes of its holes by the transfer
};

/// The state's shape on the lattice, with the same measure and the evolver's bands. Fails as
/// Evolver::with_measure() does.
template <int dim>
Expected<OnOtherGrid<dim>> on_other_grid(const OptimizationState<dim>& state, const Lattice<dim>& lattice,
                                         const Evolver<dim>& evolver);

}  // namespace wheelwright
