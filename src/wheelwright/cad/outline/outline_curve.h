#pragma once

#include <variant>
#include <vector>

#include "wheelwright/cad/curves/bezier.h"

namespace wheelwright::cad {

// Curves in the plane of the wheel, in Cartesian coordinates [m] of the body frame, or in the half-plane of a
// profile (profile.h). Each runs from its start to its end.

struct Line {
  Vec<2> start, end;
};

struct Arc {
  Vec<2> centre;
  double radius;
  double begin;  ///< azimuth of the start about the centre [rad]
  double sweep;  ///< [rad], counter-clockwise if positive; 2 pi or -2 pi is a whole circle
};

/// A cubic B-spline with continuous curvature. The knots are clamped: the first and the last four are equal,
/// and those between are simple.
struct Spline {
  static constexpr int degree = 3;
  std::vector<double> knots;
  std::vector<Vec<2>> points;  ///< control points
};

using Curve = std::variant<Line, Arc, Spline>;

Vec<2> start_of(const Curve& curve);
Vec<2> end_of(const Curve& curve);

/// At a parameter in [0, 1].
CurvePoint at(const Curve& curve, double parameter);

bool is_circle(const Curve& curve);

Curve rotated(const Curve& curve, double angle);

/// The mirror image in the line where the first coordinate is `middle` [m].
Curve mirrored(const Curve& curve, double middle);

/// The curve from its end to its start.
Curve reversed(const Curve& curve);

/// The integral of (x dy - y dx) / 2 along the curve [m^2], exactly: the areas under the curves of a closed
/// loop add up to the area that it encloses, positive if it runs counter-clockwise.
double area_under(const Curve& curve);

/// The curve as cubics, one after the other: exact for lines and splines. Arcs deviate by at most
/// `tolerance` [m].
std::vector<Bezier> beziers(const Curve& curve, double tolerance);

/// Points on the curve from its start up to, but without, its end. The chords between them and to the end
/// deviate from the curve by at most `tolerance` [m].
std::vector<Vec<2>> flattened(const Curve& curve, double tolerance);

}  // namespace wheelwright::cad
