#pragma once

#include <vector>

#include "wheelwright/cad/outline/outline_curve.h"

namespace wheelwright::cad {

/// Number of points of the Gauss rule by which OpenCASCADE, and programs built on it, integrate along an edge
/// of this many cubics by default: eight per cubic, at most 61.
int usual_points(int cubics);

/// How far the end of a part of a spline lies from where its derivative leads from its start by the usual
/// rule [m]. The part has the cubics from `first` up to, but without, `last`. Such errors do not cancel
/// around a loop: times the distance from the axle they are errors of areas and volumes.
double usual_error(const Spline& spline, int first, int last);

/// Divides a spline between its cubics into the fewest parts whose usual_error() is at most `tolerance` [m],
/// with the smallest sum of these errors: the numbers of cubics before the first part and after each part. A
/// single cubic is integrated exactly.
std::vector<int> spline_parts(const Spline& spline, double tolerance);

}  // namespace wheelwright::cad
