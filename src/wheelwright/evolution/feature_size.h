#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/geometry/topology.h"

namespace wheelwright {

/// The least width of what is cut [m]; 0: any.
struct FeatureSize {
  double wall = 0;  ///< of material between two places of the edges that face each other
  double gap = 0;   ///< of a hole, likewise, and across the hole

  bool any() const { return wall > 0 || gap > 0; }
  bool operator==(const FeatureSize&) const = default;
};

/// The larger of both widths each.
inline FeatureSize larger(const FeatureSize& a, const FeatureSize& b) {
  return {.wall = std::max(a.wall, b.wall), .gap = std::max(a.gap, b.gap)};
}

/// A ball in the material that touches its boundary at two places.
template <int dim>
struct MedialBall {
  Vec<dim> centre;  ///< Cartesian, body frame [m]
  double radius;
};

/// The balls of less than `radius` in the material that touch the boundary at two places which face each
/// other (their normals are more than 120 degrees apart), one for every seed point on {psi = 0} of a sector:
/// the middle of walls thinner than 2 `radius`. They are found by shrinking, at every seed, a ball that
/// touches the boundary there until it holds no other point of it (Ma, Bae, Choi 2012).
template <int dim>
std::vector<MedialBall<dim>> thin_walls(const LevelSet<dim>& psi, double radius);

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

/// Walls thinner than `wall` taken out: the opening, which is the closing of the holes.
template <int dim>
LevelSet<dim> without_thin_walls(const LevelSet<dim>& psi, double wall);

/// The narrowest of the walls and of the gaps that are narrower than these widths: at most one event each.
template <int dim>
std::vector<ShapeEvent<dim>> narrowest_places(const LevelSet<dim>& psi, const FeatureSize& size);

/// Both: first the gaps, whose filling makes no thin walls.
template <int dim>
LevelSet<dim> with_feature_size(const LevelSet<dim>& psi, const FeatureSize& size);

/// This tells which points of the boundary bound a wall, or a gap, that is wider than the least by at most 3
/// %.
struct AtLeastWidth {
  std::vector<bool> wall, gap;  ///< one value per point
};
template <int dim>
AtLeastWidth at_least_width(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> boundary,
                            const FeatureSize& size);

/// Which points of the boundary would narrow such a wall or gap with these speeds along the outward normal of
/// the material, one per point.
std::vector<bool> held_by_widths(const AtLeastWidth& narrow, std::span<const double> speeds);

}  // namespace wheelwright
