#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "wheelwright/cad/curves/affine.h"
#include "wheelwright/cad/curves/bezier.h"

namespace wheelwright {

/// An axis-parallel rectangle; the initial one holds no point.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(const Point& p);
  void add(const Box& other);
  bool overlaps(const Box& other) const;
  /// Square of the distance from x; 0 inside.
  double distance2(const Point& x) const;
  double size() const;  ///< length of the diagonal
};

/// The point of a curve that is nearest to another point.
struct NearestOnCurve {
  double parameter;
  double distance2;
};

/// A piece of a plane curve, exact: a line, an arc of an ellipse, or a cubic Bezier curve. It runs from
/// parameter 0 to 1. The end of one piece and the start of the next are the same two numbers, so that chains
/// of pieces have no gaps.
class Curve {
 public:
  static Curve line(const Point& from, const Point& to);
  /// The points centre + cos(t) a + sin(t) b with t [rad] from `from` to `to`, in either direction.
  static Curve arc(const Point& centre, const Point& a, const Point& b, double from, double to);
  static Curve circle_arc(const Point& centre, double radius, double from, double to);
  static Curve quadratic(const Point& p0, const Point& p1, const Point& p2);
  static Curve cubic(const Point& p0, const Point& p1, const Point& p2, const Point& p3);

  const Point& start() const { return start_; }
  const Point& end() const { return end_; }
  Point at(double s) const;
  Point derivative(double s) const;
  Point second_derivative(double s) const;

  bool is_line() const { return kind_ == Kind::line; }
  Box box() const;
  /// Whether its direction turns by less than about 45 degrees.
  bool is_simple() const;
  /// The largest distance from the chord, at most; relative to the chord's length.
  double relative_height() const;

  std::pair<Curve, Curve> split(double s) const;
  Curve part(double s0, double s1) const;
  Curve reversed() const;
  Curve mapped(const Affine& map) const;
  /// The same curve with other ends, which must be almost the same points.
  Curve with_ends(const Point& start, const Point& end) const;

  /// Exact to rounding for a simple curve.
  NearestOnCurve nearest(const Point& x) const;

 private:
  enum class Kind { line, arc, cubic };

  Curve(Kind kind, const Point& start, const Point& end) : kind_(kind), start_(start), end_(end) {}
  Bezier cubic() const { return {start_, control_[0], control_[1], end_}; }
  bool is_circular() const;
  NearestOnCurve nearest_end(const Point& x) const;
  NearestOnCurve nearest_on_line(const Point& x) const;
  NearestOnCurve nearest_on_circle(const Point& x) const;
  double stationary_between(const Point& x, double low, double high) const;

  Kind kind_;
  Point start_, end_;
  std::array<Point, 3> control_{};  ///< of an arc: centre, a, b; of a cubic: its two inner control points
  double from_ = 0, to_ = 0;        ///< of an arc
};

/// The curve as simple pieces, in its order.
std::vector<Curve> simple_pieces(const Curve& curve);

/// A place where two curves meet: their parameters.
struct Meeting {
  double s, t;
};

/// Where two simple curves cross or touch each other at single points.
std::vector<Meeting> meetings(const Curve& a, const Curve& b);

/// Whether a part of one of two simple curves lies on the other, within the tolerance [m].
bool lie_on_each_other(const Curve& a, const Curve& b, double tolerance);

/// What a ray from x in the direction of the first axis crosses: the number of times the curve passes it
/// upwards, minus downwards.
int ray_crossings(const Curve& curve, const Point& x);

}  // namespace wheelwright
