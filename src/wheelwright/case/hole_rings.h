#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case_key.h"

namespace wheelwright {

// The relative position of a case's holes. They are compared as rings: a circle is a ring with one hole per
// sector.

/// A ring of holes of the case, or a circle with its images.
struct NamedRing {
  std::string name;  ///< e.g. "holes.ring[2]"
  CaseKeys place;    ///< the keys of the radius and positions of its holes, the radius first
  HoleRing ring;     ///< with its phase
};

/// All rings and circles, in the order of the file's arrays.
std::vector<NamedRing> named_rings(const Case& c);

/// The azimuth [rad] from a hole of ring `a` to the nearest hole of ring `b`: its minimum and maximum over
/// the holes of `a`.
struct AzimuthOffsets {
  double minimum, most;
};
AzimuthOffsets azimuth_offsets(const HoleRing& a, const HoleRing& b);

/// Whether some hole of `a` lies inside a hole of `b`, or is the same.
bool lies_inside(const HoleRing& a, const HoleRing& b);

/// Whether every hole of `a` overlaps a hole of `b`.
bool overlaps_everywhere(const HoleRing& a, const HoleRing& b);

/// Diameter of the smallest hole [m]; infinite without holes. Overlapping circles are one hole, at least as
/// wide as the largest of them.
double smallest_hole_width(const Case& c);

}  // namespace wheelwright
