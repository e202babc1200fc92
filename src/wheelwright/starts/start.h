#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

// Initial shapes for optimizations of the same wheel: rings of holes, slots, ellipses and spokes of random
// numbers and places, all of the same volume.

/// What the starts of one exploration have in common.
struct StartRange {
  double volume;               ///< of the material, as a fraction of the ring
  bool keeps_sectors = false;  ///< only numbers of holes that are multiples of the case's sectors
};

/// A drawn start: the case with other holes or shapes and, where they ask for it, another number of sectors
/// on a grid of about as many cells. Its volume.target is that of the range.
struct Start {
  std::string text;  ///< e.g. "2 rings of 16 holes, staggered"
  Case source;
};

/// The start of a number, which no other start depends on. Its shape is valid on the grid of the case: no
/// wall and no hole is lost there, and its volume is that of the range to within a hundredth of the ring.
/// Nothing if no such shape was found.
std::optional<Start> draw_start(const Case& c, const StartRange& range, std::uint64_t seed, int number);

/// Material of a case's initial shape as a fraction of the ring.
double initial_volume(const Case& c);

}  // namespace wheelwright
