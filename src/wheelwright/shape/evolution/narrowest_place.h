#pragma once

#include <optional>

#include "wheelwright/shape/evolution/medial_balls.h"

namespace wheelwright {

/// Where a wall or a hole is narrowest.
template <int dim>
struct NarrowestPlace {
  double width;     ///< [m]
  Vec<dim> middle;  ///< Cartesian, body frame
};

/// The narrowest place between two opposite parts of the boundary {psi = 0}: of the walls or of the holes.
/// For walls also that between the boundary and the rim, the tread, or a side face, where they are parallel
/// to 20 degrees. Nothing if there is none that is narrower than the ring is thick.
template <int dim>
std::optional<NarrowestPlace<dim>> narrowest_place(const MedialBalls<dim>& medial, Side side);

/// The number of holes of a sector that reach no side face. A body with such a cavity can only be cast around
/// a lost core, or printed with powder or resin left inside.
int closed_cavities(const LevelSet<3>& psi);

}  // namespace wheelwright
