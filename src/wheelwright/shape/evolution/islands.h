#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {

/// A shape without islands, and the islands that were removed from it.
template <int dim>
struct AttachedShape {
  LevelSet<dim> psi;
  std::vector<ShapeEvent<dim>> removed;  ///< one event island_removed per island
};

/// Removes islands, which are pieces of material that are not attached to the rim. Inside the islands, and
/// where an island was nearer than the rest of the boundary, psi becomes the distance to the rest; elsewhere
/// it is unchanged. Fails with tread_cut_off if the tread is not attached, with disconnected_material if the
/// measure of an island in one sector exceeds `largest` [m^2, or m^3 when dim = 3], and with not_finite.
template <int dim>
Expected<AttachedShape<dim>> without_islands(const LevelSet<dim>& psi, double largest);

}  // namespace wheelwright
