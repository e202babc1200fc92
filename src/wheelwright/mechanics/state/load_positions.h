#pragma once

#include <algorithm>
#include <vector>

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The ground at one load position, in the body frame. n_y points from the axle to the undeformed tread
/// circle in ring column `column`, a fraction `offset` of the column past its first azimuth: there it touches
/// ground that is flat or a drum (WheelLoads::ground).
struct GroundPosition {
  int column;
  double offset = 0;  ///< 0 <= offset < 1
  double camber = 0;  ///< by which the wheel leans on it; when dim = 3 [rad]

  /// Azimuth of n_y [rad].
  template <int dim>
  double azimuth(const PolarGrid<dim>& grid) const {
    return (column + offset) * grid.column_angle();
  }

  bool operator==(const GroundPosition&) const = default;
};

/// The load positions that are solved.
struct LoadPositions {
  std::vector<GroundPosition> grounds;
  std::vector<double> multiplicities;  ///< number of a sector's positions that each represents
  /// Whether derivatives are wanted of functions that are not their own mirror image in the middle plane of
  /// the width: then no wheel is solved on half of its width; when dim = 3.
  bool on_whole_width = false;

  int size() const { return static_cast<int>(grounds.size()); }
  /// Whether the ground touches at the first azimuth of a column in all of them.
  bool stand_on_columns() const {
    return std::all_of(grounds.begin(), grounds.end(), [](const auto& ground) { return ground.offset == 0; });
  }
  /// Whether some also represent their mirror image in the plane of azimuth 0.
  bool stand_for_images() const {
    return std::any_of(multiplicities.begin(), multiplicities.end(), [](double m) { return m > 1; });
  }
};

/// Values of the positions that were solved for as values of all positions of the sector, in their order: an
/// image has the value of the position that represents it. Empty values stay empty.
std::vector<double> of_all(const LoadPositions& positions, const std::vector<double>& values);

/// n positions that divide one sector evenly, the first at azimuth 0.
template <int dim>
LoadPositions load_positions(const PolarGrid<dim>& grid, int n, double camber = 0);

/// Representatives: only the first of each pair that are mirror images in the plane of azimuth 0. It
/// represents both.
template <int dim>
LoadPositions load_positions_without_images(const PolarGrid<dim>& grid, int n, double camber = 0);

}  // namespace wheelwright
