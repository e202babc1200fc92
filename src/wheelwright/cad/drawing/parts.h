#pragma once

#include <vector>

#include "wheelwright/cad/drawing/drawn_outline.h"

namespace wheelwright {

// Outlines of simple parts [m, rad]. What lies about a point of the plane is placed by its `frame`: the
// part's own axes, x away from the axle and y towards larger azimuth.

DrawnOutline circle_outline(const Affine& frame, double radius);
/// `length` along the frame's x, `width` along its y.
DrawnOutline ellipse_outline(const Affine& frame, double length, double width);
/// A rectangle with round ends: `length` over all along the frame's x.
DrawnOutline slot_outline(const Affine& frame, double length, double width);
DrawnOutline polygon_outline(const std::vector<Point>& corners);
DrawnOutline annulus_outline(double inner_radius, double outer_radius);

/// A strip of constant thickness about a circular arc (or the straight line, if `bend` is 0) from one point
/// to another. `bend` [rad] is the angle by which the strip turns to the left on its way.
DrawnOutline strip_outline(const Point& from, const Point& to, double thickness, double bend);

/// The point at these polar coordinates, and the frame there that is turned by `angle`.
Point polar(double radius, double azimuth);
Affine polar_frame(double radius, double azimuth, double angle);

}  // namespace wheelwright
