#pragma once

#include <functional>
#include <optional>
#include <string>

#include "wheelwright/case/case.h"
#include "wheelwright/design/starts/random.h"
#include "wheelwright/design/starts/start.h"

namespace wheelwright {

/// A start whose numbers and places have been drawn at random, with one free size by which its volume is
/// matched.
struct Draft {
  std::string text;
  int sectors;
  double minimum, most;                            ///< sizes that leave walls and gaps of at least one cell
  std::function<void(Case& c, double size)> draw;  ///< on a case without holes and shapes
};

/// Constraints on the drafts of a case.
struct DraftSpace {
  double inner, outer;  ///< radii between which holes may lie [m]
  double wall;          ///< thinnest wall or gap [m]
  int sectors;          ///< numbers of holes must be multiples of it
};

/// Constraints on drafts of wheels in 3D along the axle.
struct AxialSpace {
  double width;  ///< of the wheel [m]
  double wall;   ///< thinnest wall along the axle [m]
  int sectors;   ///< of bodies of revolution, which fit any number
  /// z of the plane in which holes are smallest: where the halves of a mould meet, or the plate on which a
  /// wheel is printed [m].
  std::optional<double> kept = {};
};

/// One function per kind; nothing if the drawn numbers leave no room.
std::optional<Draft> draft_rings(const DraftSpace& space, Random& random, int n_rings, bool staggered);
/// Rings of round holes whose radius changes along the axle.
std::optional<Draft> draft_tapered_holes(const DraftSpace& space, const AxialSpace& across, Random& random);
std::optional<Draft> draft_slots(const DraftSpace& space, Random& random);
std::optional<Draft> draft_ellipses(const DraftSpace& space, Random& random);
std::optional<Draft> draft_spokes(const DraftSpace& space, Random& random, SpokeKind kind);

}  // namespace wheelwright
