#pragma once

#include <optional>

#include "wheelwright/design/starts/draft.h"

namespace wheelwright {

// Starts of wheels in 3D that are bodies of revolution: discs between rim and tread, left by grooves in the
// side faces. The free size is the depth of the grooves, of both sides together.

/// How the disc lies in the width of the wheel.
enum class DiscKind {
  middle,    ///< in the middle, or where it must be (AxialSpace::kept)
  offset,    ///< nearer to one side, or at it
  leaning,   ///< from one side at the rim to the other at the tread, as a dish
  tapering,  ///< thinner at the rim or at the tread
};

/// One function per kind; nothing if the drawn numbers leave no room.
std::optional<Draft> draft_disc(const DraftSpace& space, const AxialSpace& across, Random& random,
                                DiscKind kind);

/// A disc that changes from one side face to the other and back: grooves in alternating sides, each deeper
/// than half of the width.
std::optional<Draft> draft_folded_disc(const DraftSpace& space, const AxialSpace& across, Random& random,
                                       int n_grooves);

}  // namespace wheelwright
