#pragma once

#include <optional>

#include "wheelwright/cad/outline/outline.h"

namespace wheelwright::cad {

// How rough the edges of holes are at a given length, such as a cell of the grid: teeth, ripples and corners
// that are as small as that. Details that are much smaller than the length are left out, because they depend
// on how curves were fitted: the kinks of a few degrees where the polynomials of two cells meet are nothing
// that a cutter would notice. Therefore the curvature kappa of the edge is averaged: with arc length s, the
// direction theta of the tangent and w a third of the length,
//
//   mean kappa(s) = integral over |u| < w of (1 - |u| / w) / w dtheta(s + u),
//
// where a corner counts with the angle by which theta jumps there. A bend by the angle alpha that is shorter
// than w has the mean radius w / alpha, a right angle 0.2 lengths.

/// A place of an edge with its mean radius of curvature.
struct Bend {
  double radius;  ///< [m]
  Vec<2> place;
};

/// The roughness of one edge.
struct EdgeRoughness {
  /// 1 / (2 pi) times the integral of |mean kappa| along the edge, where that is more than one by the length.
  /// At most 1 if the edge bends only one way; every tooth adds up to a half.
  double turns;
  Bend sharpest;  ///< where |mean kappa| is largest
  /// The smallest mean radius with its centre in the void: a round tool in the hole must be smaller. Nothing
  /// if the edge bends that way by at most 0.01 rad per length everywhere.
  std::optional<Bend> internal_corner;
  /// The smallest mean radius with its centre in the material, a tip of it.
  std::optional<Bend> external_corner;
};

/// Measures a closed edge that is no circle about the axle; `length` [m]. The result is the same for any
/// first curve and any division of the edge into curves, up to 1e-3 turns.
EdgeRoughness edge_roughness(const Loop& loop, double length);

/// The roughest edge of an outline, and the smallest radii of all.
struct Roughness {
  double length;       ///< at which it was measured [m]
  EdgeRoughness edge;  ///< the edge with the most turns
  std::optional<Bend> internal_corner, external_corner;
};

/// Measures the edges of holes and islands; of those that are images of each other by a rotation by whole
/// sectors, one. Outer edge and bore are circles and left out. Nothing if there are no holes.
std::optional<Roughness> roughness(const Outline& outline, int n_sectors, double length);

}  // namespace wheelwright::cad
