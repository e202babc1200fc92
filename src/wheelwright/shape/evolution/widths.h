#pragma once

#include "wheelwright/shape/evolution/boundary_motion.h"
#include "wheelwright/shape/evolution/feature_size.h"

namespace wheelwright {

enum class WidthKind {
  wall,    ///< of material
  gap,     ///< of a hole
  corner,  ///< the radius of an internal corner of a hole
};

/// The width of a wall or gap at one place, and its derivative: the diameter of the ball there that touches
/// the boundary on both sides or, if that is about the minimum width or less, the length of the shortest
/// chord nearby. At an internal corner, the radius of the boundary there.
template <int dim>
struct Width {
  WidthKind kind;
  double value;    ///< [m]
  double minimum;  ///< that is allowed [m]
  Vec<dim> place;  ///< of the middle of the ball, or of the corner: radius, azimuth[, axial], in the sector
                   ///< [m, rad[, m]]
  std::vector<Dependence> slopes;  ///< derivatives of the value by the coefficients of the shape's spline
  /// How much narrower the wall or gap is between the edges of the level set itself than between those of its
  /// cubic interpolant, which `value` measures: the most within a cell along its sides; at least 0 [m].
  double narrower = 0;

  /// The missing width relative to the minimum; negative if there is none. At corners, the relative excess of
  /// the curvature over the allowed one, which is approximately linear in the coefficients.
  double gap() const { return kind == WidthKind::corner ? minimum / value - 1 : 1 - value / minimum; }
};

/// Widths that exceed the minimum by less than `reach` [m]; corners by at most a fifth of the minimum radius.
/// Of widths of a kind less than a cell apart (corners: half a cell), only the most critical one is returned.
/// If the shape is mirror-symmetric, mirror images are included. The balls touch the boundary itself, not
/// only its seeds, so that values and derivatives agree.
template <int dim>
std::vector<Width<dim>> narrow_widths(const LevelSet<dim>& psi, const FeatureSize& size, double reach);

/// The same, with minimum widths that are larger by `narrower`: with them the level set itself has those of
/// `size`.
template <int dim>
std::vector<Width<dim>> narrow_widths_with_margin(const LevelSet<dim>& psi, const FeatureSize& size,
                                                  double reach);

/// The missing part of the most critical width, relative; 0 if none, NaN if a width is not finite.
template <int dim>
double largest_gap(const std::vector<Width<dim>>& widths);

/// The derivative of a width's gap() with respect to the deformation, as a load. `motion`: of the same shape.
template <int dim>
std::vector<double> gap_load(const BoundaryMotion<dim>& motion, const Width<dim>& width);

}  // namespace wheelwright
