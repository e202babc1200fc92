#pragma once

#include <span>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/drawing/composition.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// A stroke drawn over a shape: the union of some outlines, widened.
struct Stroke {
  Figure figure;
  double growth = 0;  ///< by which the edge moves outwards [m]
};

/// The shape with a stroke drawn over it in all sectors: near its edges the distance to them (in 3D a
/// cylinder along the axle); unchanged where it covers nothing.
template <int dim>
LevelSet<dim> with_stroke(const LevelSet<dim>& psi, const Stroke& stroke);

/// The free contour of the hole that contains a point, as a polyline (Cartesian, body frame [m]). Empty if
/// the point is not in a hole, or in one that surrounds the axle or touches rim or tread.
std::vector<Point> hole_contour(const LevelSet<2>& psi, const Point& point);

/// The centre of the area inside a closed polyline.
Point centroid(std::span<const Point> corners);

}  // namespace wheelwright
