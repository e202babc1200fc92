#pragma once

#include "wheelwright/contact/reduced_contact.h"
#include "wheelwright/ring/sector_fields.h"

namespace wheelwright {

/// The loads of (1) on the structure itself.
template <int dim>
struct DistributedLoads {
  Vec<dim> body_force{};     ///< f in the ground frame: component 0 towards the ground, 1 along it [N/m^3]
  double hole_pressure = 0;  ///< p, g_N = -p n on the moving boundary [Pa]

  bool any() const { return norm<dim>(body_force) > 0 || hole_pressure != 0; }
};

/// Those loads at all load positions. Load cases and columns as in RollingSolution; empty when there are
/// none.
struct AppliedLoads {
  SectorFields core;                 ///< modes: unit forces along a sector's axes, unit pressure
  Matrix tread;                      ///< on the tread's observations
  std::vector<RimForce> on_the_rim;  ///< their work on the rim's motions, one a position
};

template <int dim>
AppliedLoads applied_loads(const DistributedLoads<dim>& loads, const CutDomain<dim>& domain,
                           const ElementTable<dim>& elements, const CyclicStiffness<dim>& ring,
                           const Tread<dim>& tread, std::span<const GroundPosition> grounds);

}  // namespace wheelwright
