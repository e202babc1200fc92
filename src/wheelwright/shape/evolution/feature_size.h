#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {

/// The minimum widths of features [m]; 0: any.
struct FeatureSize {
  double wall = 0;    ///< of material between two opposite edges, in 3D also between an edge and a side face
  double gap = 0;     ///< of a hole, between two opposite edges
  double radius = 0;  ///< of internal corners, whose centre is in a hole

  bool any() const { return wall > 0 || gap > 0 || radius > 0; }
  bool operator==(const FeatureSize&) const = default;
};

/// The larger of both values for each width.
inline FeatureSize larger(const FeatureSize& a, const FeatureSize& b) {
  return {.wall = std::max(a.wall, b.wall),
          .gap = std::max(a.gap, b.gap),
          .radius = std::max(a.radius, b.radius)};
}

/// Thickens walls thinner than `wall` on both sides to that width plus 2 %: adds a ball of that diameter at
/// each of thin_walls(), and in 3D beside side faces (walls_to_faces()), and balls up to 24 % larger where a
/// neck between the nodes is still too thin. Elsewhere the shape is unchanged.
template <int dim>
LevelSet<dim> with_thick_walls(const LevelSet<dim>& psi, double wall);

/// Fills holes, and parts of holes, narrower than `gap`: near the middle of such gaps the material is moved
/// outward by half of it and back, each from the signed distance (closing, Serra 1982). Where gaps remain
/// narrow, because their filling lies between the nodes, wider ones are filled too, by a tenth of `gap` more
/// each time. All holes smaller than a ball of that diameter are filled. Elsewhere the shape is unchanged.
template <int dim>
LevelSet<dim> without_narrow_gaps(const LevelSet<dim>& psi, double gap);

/// Rounds internal corners with less than this radius: near them the coefficients of the spline diffuse until
/// all have it. (Closing would also fill slits up to about twice the radius, whose remainders are lost
/// between the nodes.) Elsewhere the shape is unchanged; level sets of degree 1 are not changed at all.
template <int dim>
LevelSet<dim> with_round_corners(const LevelSet<dim>& psi, double radius);

/// Removes walls thinner than `wall`: the opening, which is the closing of the holes.
template <int dim>
LevelSet<dim> without_thin_walls(const LevelSet<dim>& psi, double wall);

/// The first hole that is smaller than a ball of this diameter, if there is one. It may lie between the
/// nodes, where MedialBalls has too few seeds to detect it.
template <int dim>
std::optional<ShapeEvent<dim>> small_hole(const LevelSet<dim>& psi, double gap);

/// The narrowest of the walls and of the gaps that are narrower than these widths, and the sharpest of the
/// corners that are sharper: at most one event each.
template <int dim>
std::vector<ShapeEvent<dim>> narrowest_places(const LevelSet<dim>& psi, const FeatureSize& size);

/// Enforces all widths: first the gaps, whose filling creates no thin walls, and the corners last.
template <int dim>
LevelSet<dim> with_feature_size(const LevelSet<dim>& psi, const FeatureSize& size);

}  // namespace wheelwright
