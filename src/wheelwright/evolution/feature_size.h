#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/geometry/topology.h"

namespace wheelwright {

/// The least width of what is cut [m]; 0: any.
struct FeatureSize {
  double wall = 0;    ///< of material between two places of the edges that face each other
  double gap = 0;     ///< of a hole, likewise, and across the hole
  double radius = 0;  ///< of internal corners, whose centre is in a hole

  bool any() const { return wall > 0 || gap > 0 || radius > 0; }
  bool operator==(const FeatureSize&) const = default;
};

/// The larger of both widths each.
inline FeatureSize larger(const FeatureSize& a, const FeatureSize& b) {
  return {.wall = std::max(a.wall, b.wall),
          .gap = std::max(a.gap, b.gap),
          .radius = std::max(a.radius, b.radius)};
}

/// Walls thinner than `wall` with material added on both sides until they are as thick, and 2 % more: a ball
/// of that diameter is put in the place of every one of thin_walls(), and larger ones, up to 24 %, where a
/// neck between the nodes is still too thin. Elsewhere the shape stays as it is.
template <int dim>
LevelSet<dim> with_thick_walls(const LevelSet<dim>& psi, double wall);

/// Holes, and parts of holes, between whose edges less than `gap` is left are filled: near the middle of such
/// gaps the material is moved outward by half of it and back, each from the signed distance (closing, Serra
/// 1982). Where gaps stay narrow, because what fills them lies between the nodes, wider ones are filled too,
/// by a tenth of `gap` more each time. Holes that are smaller than a ball of that diameter are filled
/// wherever they are. Elsewhere the shape stays as it is.
template <int dim>
LevelSet<dim> without_narrow_gaps(const LevelSet<dim>& psi, double gap);

/// Internal corners whose radius is less than this one are rounded: near them the coefficients of the spline
/// diffuse until all are as round. (Closing would fill slits that are about twice as wide as the radius: what
/// is left of them on the way is lost between the nodes.) Elsewhere the shape stays as it is; level sets of
/// degree 1 do everywhere.
template <int dim>
LevelSet<dim> with_round_corners(const LevelSet<dim>& psi, double radius);

/// Walls thinner than `wall` taken out: the opening, which is the closing of the holes.
template <int dim>
LevelSet<dim> without_thin_walls(const LevelSet<dim>& psi, double wall);

/// The first hole that is smaller than a ball of this diameter, if there is one. It may lie between the
/// nodes, where MedialBalls has too few seeds to see it.
template <int dim>
std::optional<ShapeEvent<dim>> small_hole(const LevelSet<dim>& psi, double gap);

/// The narrowest of the walls and of the gaps that are narrower than these widths, and the sharpest of the
/// corners that are sharper: at most one event each.
template <int dim>
std::vector<ShapeEvent<dim>> narrowest_places(const LevelSet<dim>& psi, const FeatureSize& size);

/// All: first the gaps, whose filling makes no thin walls, and the corners at last.
template <int dim>
LevelSet<dim> with_feature_size(const LevelSet<dim>& psi, const FeatureSize& size);

}  // namespace wheelwright
