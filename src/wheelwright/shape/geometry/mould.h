#pragma once

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// A mould of two halves that open along the axle and meet in the plane z = parting_plane, the nearest one
/// between cells. Away from it, on both sides, the material's edges recede by at least `slope` per length.
struct Mould {
  double parting_plane;  ///< [m]
  double slope;          ///< tangent of the draft; 0: no undercut

  bool operator==(const Mould&) const = default;
};

/// The parting plane, counted from z = 0 between cells.
inline int parting_plane_of(const Mould& mould, const PolarGrid<3>& grid) {
  const int nearest = static_cast<int>(std::lround(mould.parting_plane / grid.axial_size()));
  return std::clamp(nearest, 0, grid.cells[2]);
}

}  // namespace wheelwright
