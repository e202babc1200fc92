#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

// Initial shapes for optimizations of the same wheel, with random numbers and places, all of the same volume:
// rings of holes, slots, ellipses and spokes; in 3D also discs and holes that change along the axle, as far
// as the wheel can be made so.

/// Common properties of the starts of an exploration.
struct StartRange {
  double volume;               ///< of the material, as a fraction of the ring
  bool keeps_sectors = false;  ///< only numbers of holes that are multiples of the case's sectors
};

/// A random start: the case with other holes or shapes and, if they require it, another number of sectors on
/// a grid of about as many cells. Its volume.target is that of the range if the case fixes its volume.
struct Start {
  std::string text;  ///< e.g. "2 rings of 16 holes, staggered"
  Case source;
};

/// Statistics of failed attempts.
struct FailedAttempts {
  int without_room = 0;   ///< the numbers drawn leave no room for walls and gaps
  int off_volume = 0;     ///< no size has the volume of the range
  int refused = 0;        ///< the case is not valid
  int unresolved = 0;     ///< the grid loses walls or holes
  std::string refusal{};  ///< the first problem of the first refused case

  int total() const { return without_room + off_volume + refused + unresolved; }
  FailedAttempts& operator+=(const FailedAttempts& other);
};

/// E.g. "41 attempts failed: no room 30, off the volume 11". Empty if none failed.
std::string to_string(const FailedAttempts& attempts);

struct DrawnStart {
  std::optional<Start> start;
  FailedAttempts failed;
};

enum class StartKind {
  one_ring,
  two_rings,
  two_staggered_rings,
  three_rings,
  three_staggered_rings,
  plain_spokes,  ///< straight or curved
  split_spokes,  ///< forked or in pairs
  slots,
  ellipses,
  tapered_holes,
  middle_disc,
  offset_disc,
  leaning_disc,
  tapering_disc,
  disc_folded_once,
  disc_folded_twice,
};

/// The kinds in which a case's wheel can be made; consecutive starts take turns.
std::vector<StartKind> kinds_of_starts(const Case& c);

/// The start with a number, independent of all others. Its shape is valid on its grid: no wall and no hole is
/// lost there, and its volume is that of the range to within a hundredth of the ring. There is none if a
/// bounded number of attempts fail, or if `must_end`, which is called before each of them, returns true.
DrawnStart draw_start(
    const Case& c, const StartRange& range, std::uint64_t seed, int number,
    const std::function<bool()>& must_end = [] { return false; });

/// Material of a case's initial shape as a fraction of the ring.
double initial_volume(const Case& c);

}  // namespace wheelwright
