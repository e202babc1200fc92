#pragma once

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The side faces of a wheel in 3D: z = 0 and z = width.
enum class SideFace { smaller_z, larger_z };

/// A wheel that is printed in layers across the axle, standing on a side face. Away from that face the edges
/// of holes lean over by at most `slope` per length.
struct Print {
  SideFace plate;  ///< the side face on which the wheel stands
  double slope;    ///< tangent of the largest overhang, an angle against the axle; not negative

  bool operator==(const Print&) const = default;
};

/// The longest edge of a cell across the axle [m]. From one layer of cells to the next, the edges of holes
/// lean over by at most this length, whatever overhang is allowed.
inline double longest_edge_across(const PolarGrid<3>& grid) {
  double longest = grid.column_angle() * 0.5 * (grid.inner_radius + grid.outer_radius);
  for (const EqualRows& rows : grid.all_equal_rows()) longest = std::max(longest, rows.height());
  return longest;
}

/// Tangent of the largest overhang on this grid.
inline double slope_on(const PolarGrid<3>& grid, const Print& print) {
  return std::min(print.slope, longest_edge_across(grid) / grid.axial_size());
}

}  // namespace wheelwright
