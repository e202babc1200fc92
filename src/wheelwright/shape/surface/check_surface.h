#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/vec.h"

namespace wheelwright {

/// What a closed surface encloses.
struct SurfaceReport {
  int bodies;                ///< connected pieces whose normals point outwards
  int cavities;              ///< connected pieces inside of bodies, whose normals point into the cavity
  int euler_characteristic;  ///< vertices - edges + triangles: 2 per piece, less 2 per handle
  double volume;             ///< enclosed, in the unit of the points, cubed

  int handles() const { return bodies + cavities - euler_characteristic / 2; }
};

/// Why a surface does not bound a solid.
struct SurfaceFault {
  std::string what;  ///< one sentence
  Vec<3> place;      ///< in the unit of the points
};

/// Checks that triangles bound a solid: every side of a triangle is shared with exactly one other one, in the
/// opposite direction; the triangles around a vertex form one fan; no triangle has the area 0; no two
/// vertices are at the same place; all vertices are used; every piece encloses a volume other than 0.
Expected<SurfaceReport, SurfaceFault> check_surface(std::span<const Vec<3>> points,
                                                    std::span<const std::array<int, 3>> triangles);

}  // namespace wheelwright
