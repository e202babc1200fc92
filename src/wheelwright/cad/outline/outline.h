#pragma once

#include <span>
#include <string>
#include <vector>

#include "wheelwright/cad/outline/outline_curve.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright::cad {

enum class LoopKind { outer_edge, bore, hole, island };

/// The name of a kind for layers and groups, e.g. "outer_edge".
const char* name(LoopKind kind);

/// A closed chain of curves, each starting where the previous one ends. The material is on the left: outer
/// edge and islands run counter-clockwise, bore and holes clockwise.
struct Loop {
  LoopKind kind;
  std::vector<Curve> curves;
};

/// The whole boundary of a wheel's material: the outer edge, the bore, then the holes and islands.
struct Outline {
  std::vector<Loop> loops;
};

/// Enclosed area [m^2]: positive if the loop runs counter-clockwise.
double signed_area(const Loop& loop);

/// Area of the material [m^2].
double material_area(const Outline& outline);

/// A separate piece of material.
struct Body {
  const Loop* edge;                ///< the outer edge or an island
  std::vector<const Loop*> holes;  ///< in it: bore and holes
};

/// The pieces of an outline whose loops do not cross; they refer to it.
std::vector<Body> bodies(const Outline& outline);

/// How many curves an outline consists of.
struct CurveCount {
  int loops, lines, arcs, splines;  ///< a circle is an arc
  int cubics;                       ///< pieces of the splines between their knots
};
CurveCount count(const Outline& outline);

/// The numbers as text, e.g. "18 loops: 2 arcs and 16 splines of 412 cubics".
std::string text(const CurveCount& count);

/// Why an outline cannot be created or must not be used.
struct OutlineFault {
  std::string what;  ///< one line, with the place
};

/// A Cartesian point as text, e.g. "azimuth 12.34 deg, radius 270.1 mm".
std::string place_of(const Vec<2>& point);

/// A loop as a closed polygon that deviates by at most `tolerance` [m].
std::vector<Vec<2>> flattened(const Loop& loop, double tolerance);

}  // namespace wheelwright::cad
