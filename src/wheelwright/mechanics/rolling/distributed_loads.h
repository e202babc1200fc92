#pragma once

#include "wheelwright/mechanics/contact/reduced_contact.h"
#include "wheelwright/mechanics/ring/sector_fields.h"

namespace wheelwright {

/// Body force and pressure at all load positions. Load cases and columns as in RollingSolution; empty when
/// there are none.
struct AppliedLoads {
  SectorFields core;  ///< modes: unit forces along a sector's axes, unit pressure, unit rotation
  Matrix tread;       ///< on the tread's observations
  std::vector<RimForce> on_the_rim;  ///< their work on the rim's motions, one per position
};

template <int dim>
AppliedLoads applied_loads(const DistributedLoads<dim>& loads, const CutDomain<dim>& domain,
                           const ElementTable<dim>& elements, const CyclicStiffness<dim>& ring,
                           const Tread<dim>& tread, std::span<const GroundPosition> grounds);

}  // namespace wheelwright
