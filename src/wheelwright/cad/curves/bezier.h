#pragma once

#include <array>
#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Four control points of a cubic Bezier curve, which runs from parameter 0 to 1.
using Bezier = std::array<Vec<2>, 4>;

struct CurvePoint {
  Vec<2> position;
  Vec<2> velocity;  ///< derivative with respect to the parameter
};
CurvePoint at(const Bezier& cubic, double parameter);

/// The integral of (x dy - y dx) / 2 along the cubic, exactly.
double area_under(const Bezier& cubic);

/// Number of equal steps of the parameter whose chords deviate from the cubic by at most `tolerance`.
int n_chords(const Bezier& cubic, double tolerance);

/// The cubic as cubics over equal parts of its parameter.
std::vector<Bezier> divided(const Bezier& cubic, int parts);

}  // namespace wheelwright
