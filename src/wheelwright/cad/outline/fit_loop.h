#pragma once

#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/contour_samples.h"
#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/cad/outline/spline_fit.h"

namespace wheelwright::cad {

/// Distance of the samples of a contour, in tolerances: a spline that rounds a kink of 20 degrees within the
/// tolerance has knots about 40 tolerances apart.
inline constexpr double sample_distance = 3;

/// Curves that follow a closed contour within `tolerance` [m]: a circle or a closed spline, or, between
/// corners, lines, arcs and splines. The corners are kinks of more than 20 degrees, and smaller ones that no
/// spline follows otherwise. A part of the tolerance is left for the curve between the samples.
Expected<std::vector<Curve>, NoFit> fit_loop(const ContourSamples& samples, double tolerance);

/// The same from the first sample to the last.
Expected<std::vector<Curve>, NoFit> fit_chain(const ContourSamples& samples, double tolerance);

}  // namespace wheelwright::cad
