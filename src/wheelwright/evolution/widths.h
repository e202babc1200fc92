#pragma once

#include "wheelwright/evolution/boundary_motion.h"
#include "wheelwright/evolution/feature_size.h"

namespace wheelwright {

/// The width of a wall, or of a gap, at one place, and how it changes as the boundary moves: the diameter of
/// the ball there that touches the boundary on both sides; where that is about the least width or less, the
/// length of the shortest chord nearby.
template <int dim>
struct Width {
  double value;    ///< [m]
  double least;    ///< that it may have [m]
  Vec<dim> place;  ///< the middle of the ball: radius, azimuth[, axial], in the sector [m, rad[, m]]
  bool is_wall;
  std::array<Vec<dim>, 2>
      ends;  ///< where it touches the boundary, in units of the node spacing, in the sector
  std::array<double, 2> slopes;  ///< derivatives of the value by the speed of each end along its normal

  /// How much is missing, relative to the least width; negative where there is more.
  double gap() const { return 1 - value / least; }
};

/// Widths that exceed the least one by less than `reach` [m]. Of widths of a kind whose places are less than
/// a cell apart it has the most critical only, and, where the shape is mirror-symmetric, its mirror images.
/// The balls touch the boundary itself, not only the seeds on it, so that values and derivatives agree.
template <int dim>
std::vector<Width<dim>> narrow_widths(const LevelSet<dim>& psi, const FeatureSize& size, double reach);

/// How much is missing of the most critical width, relative; 0 if nothing is, NaN if a width is not finite.
template <int dim>
double largest_gap(const std::vector<Width<dim>>& widths);

/// The motion of the ends of all widths of a shape, two per width. `motion`: of that shape.
template <int dim>
BoundaryMotion<dim> motion_of_ends(const BoundaryMotion<dim>& motion, const LevelSet<dim>& psi,
                                   const std::vector<Width<dim>>& widths);

/// The derivative of the gap() of one of the widths by the deformation, as a load.
template <int dim>
std::vector<double> gap_load(const BoundaryMotion<dim>& ends, const std::vector<Width<dim>>& widths,
                             std::size_t width);

}  // namespace wheelwright
