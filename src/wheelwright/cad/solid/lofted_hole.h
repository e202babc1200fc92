#pragma once

#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/solid/spline_surface.h"
#include "wheelwright/shape/surface/deviation.h"
#include "wheelwright/shape/surface/sides.h"
#include "wheelwright/shape/surface/zero_surface.h"

namespace wheelwright::cad {

/// A piece of the surface of holes between two edges in side faces, or around one: a groove, a through hole
/// or a pocket.
struct HolePiece {
  const SurfaceMesh& mesh;
  const Sides& sides;  ///< of the mesh
  std::vector<int> first,
      other;    ///< sides of the hole's triangles at its edges; `other` is empty for a pocket
  Vec<2> axis;  ///< a line along the axle, around which every half-plane meets the piece in one curve
};

/// The surface through points of {psi = 0} in half-planes around the axis: u is proportional to the azimuth
/// about it, from azimuth 0 on, and v in each half-plane to the length of the curve from the first edge to
/// the other or, in a pocket, to the axis. Fewest intervals, in powers of two, with which it lies within
/// `tolerance` [m] of {psi = 0}. Fails, with the reason, where a half-plane does not meet the piece in one
/// curve, where the surface would fold, and where no surface suffices.
Expected<SplineSurface, std::string> lofted_hole(const HolePiece& piece, const ZeroSurface& zero,
                                                 double tolerance);

/// The largest distance of the surface from {psi = 0}, with `parts` samples per interval.
SurfaceDeviation deviation(const SplineSurface& surface, const ZeroSurface& zero, int parts);

}  // namespace wheelwright::cad
