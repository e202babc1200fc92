#pragma once

#include <span>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/drawing/composition.h"
#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// What is drawn over a shape: the union of some outlines, made wider.
struct Stroke {
  Figure figure;
  double growth = 0;  ///< by which the edge of the figure moves outwards [m]
};

/// The shape with a stroke drawn over it in all sectors: near its edges the distance to them (in 3D a
/// cylinder along the axle), where it covers nothing the shape as it was.
template <int dim>
LevelSet<dim> with_stroke(const LevelSet<dim>& psi, const Stroke& stroke);

/// The free contour of the material round a point that is in a hole, as a polyline (Cartesian, body frame
/// [m]). Empty where the point is in no hole, or in one that goes round the axle or touches rim or tread.
std::vector<Point> hole_contour(const LevelSet<2>& psi, const Point& point);

/// The centre of the area inside a closed polyline.
Point centroid(std::span<const Point> corners);

}  // namespace wheelwright
