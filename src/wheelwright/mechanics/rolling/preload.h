#pragma once

#include "wheelwright/mechanics/rolling/distributed_loads.h"
#include "wheelwright/mechanics/rolling/factored_shape.h"
#include "wheelwright/mechanics/rolling/standing_point.h"
#include "wheelwright/mechanics/state/rolling_model.h"

namespace wheelwright {

/// Loads in the core after elimination: their modes, and what they are on the boundary.
template <int dim>
struct CondensedLoads {
  SectorFields core;
  typename CyclicStiffness<dim>::EliminatedInterface boundary;
};

/// The loads of a model that are not the ground's, at some load positions, and what they do without it.
template <int dim>
struct Preloaded {
  SectorFields core_loads;  ///< of body force and pressure, in the core; empty: none
  Matrix tread_loads;       ///< of body force, on the tread's observations
  CondensedLoads<dim> condensed;
  std::vector<Preload> positions;            ///< of every position
  std::vector<StandingPoint<dim>> standing;  ///< of every position if the wheel rotates; else empty
};

template <int dim>
Preloaded<dim> preload(const RollingModel<dim>& model, const ElementTable<dim>& elements,
                       const Tread<dim>& tread, const FactoredShape<dim>& shape,
                       const LoadPositions& positions);

}  // namespace wheelwright
