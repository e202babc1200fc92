#pragma once

#include "wheelwright/evolution/boundary_motion.h"
#include "wheelwright/evolution/feature_size.h"

namespace wheelwright {

enum class WidthKind {
  wall,    ///< of material
  gap,     ///< of a hole
  corner,  ///< the radius of an internal corner of a hole
};

/// The width of a wall, or of a gap, at one place, and how it changes with the shape: the diameter of the
/// ball there that touches the boundary on both sides; where that is about the least width or less, the
/// length of the shortest chord nearby. At an internal corner, the radius of the boundary there.
template <int dim>
struct Width {
  WidthKind kind;
  double value;    ///< [m]
  double least;    ///< that it may have [m]
  Vec<dim> place;  ///< of the middle of the ball, or of the corner: radius, azimuth[, axial], in the sector
                   ///< [m, rad[, m]]
  std::vector<Dependence> slopes;  ///< derivatives of the value by the coefficients of the shape's spline

  /// How much is missing, relative to the least width; negative where there is more. At corners, how much
  /// larger the curvature is than it may be, relative, which is about linear in the coefficients.
  double gap() const { return kind == WidthKind::corner ? least / value - 1 : 1 - value / least; }
};

/// Widths that exceed the least one by less than `reach` [m]; corners by at most a fifth of the least radius.
/// Where widths of a kind are less than a cell apart (corners: half a cell), only the most critical one is
/// returned. Where the shape is mirror-symmetric, its mirror images are returned too. The balls touch the
/// boundary itself, not only the seeds on it, so that values and derivatives agree.
template <int dim>
std::vector<Width<dim>> narrow_widths(const LevelSet<dim>& psi, const FeatureSize& size, double reach);

/// How much is missing of the most critical width, relative; 0 if nothing is, NaN if a width is not finite.
template <int dim>
double largest_gap(const std::vector<Width<dim>>& widths);

/// The derivative of the gap() of a width by the deformation, as a load. `motion`: of the same shape.
template <int dim>
std::vector<double> gap_load(const BoundaryMotion<dim>& motion, const Width<dim>& width);

}  // namespace wheelwright
