#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/geometry/topology.h"

namespace wheelwright {

/// A shape whose material all hangs together, and what was taken out for that.
template <int dim>
struct AttachedShape {
  LevelSet<dim> psi;
  std::vector<ShapeEvent<dim>> removed;  ///< island_removed, one an island
};

/// Takes islands, material that is not attached to the rim, out of a shape: psi becomes the distance to the
/// rest of the boundary in them and where they were the nearest; elsewhere it keeps its values. Fails with
/// tread_cut_off when the tread is not attached, with disconnected_material for an island larger than
/// `largest` [m^2 in one sector, or m^3], with not_finite where psi is not finite.
template <int dim>
Expected<AttachedShape<dim>> without_islands(const LevelSet<dim>& psi, double largest);

}  // namespace wheelwright
