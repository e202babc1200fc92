#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/outline.h"

namespace wheelwright::cad {

/// The boundary of {psi < 0} in the full ring by few curves that deviate by at most `tolerance` [m] from the
/// zero contour on the isoparametric cells of psi. Outer edge and bore are circles. Between its corners a
/// hole's edge is a line, an arc, or a spline with continuous curvature. The curves of one sector are
/// repeated around the wheel. Fails where holes break through the outer edge or the bore, and where no curve
/// follows the contour.
Expected<Outline, OutlineFault> fit_outline(const LevelSet<2>& psi, double tolerance);

}  // namespace wheelwright::cad
