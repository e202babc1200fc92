#pragma once

#include <vector>

#include "wheelwright/shape/evolution/jet.h"
#include "wheelwright/shape/evolution/spline_level_set.h"

namespace wheelwright {

/// The largest principal curvature of {f = 0} at a point where f has this jet, and its derivatives; positive
/// where the part with f < 0 is convex: 1 / r for f = |x| - r.
template <int dim>
struct PrincipalCurvature {
  double value;          ///< [1/m]
  Vec<dim> by_gradient;  ///< derivative by the gradient of f
  Mat<dim> by_hessian;   ///< derivative by the Hessian of f
};
template <int dim>
PrincipalCurvature<dim> principal_curvature(const Jet<dim>& f);

/// A point where the edge of a spline crosses a line parallel to an axis of the grid.
template <int dim>
struct EdgePoint {
  std::array<int, dim> cell;
  Vec<dim> xi;       ///< in the unit cell
  int axis;          ///< of the line
  Vec<dim> place;    ///< radius, azimuth[, axial], in the sector [m, rad[, m]]
  double curvature;  ///< of the holes there, the largest one; positive at internal corners [1/m]
};

/// The points of the edge where it crosses lines a quarter of a cell apart and the curvature of the holes is
/// at least this one. For level sets of degree 2.
template <int dim>
std::vector<EdgePoint<dim>> internal_corners(const LevelSet<dim>& coefficients, double curvature);

/// The dependence of the curvature at such a point, which stays on its line, on the coefficients.
template <int dim>
std::vector<Dependence> curvature_dependence(const LevelSet<dim>& coefficients, const EdgePoint<dim>& point);

}  // namespace wheelwright
