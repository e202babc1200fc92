#pragma once

#include "wheelwright/evolution/deformation_space.h"
#include "wheelwright/evolution/widths.h"

namespace wheelwright {

/// The deformation of least norm under which, to first order, no width is less than it may be, and under
/// which the sum of `kept`, derivatives of what must not change, is zero: a step of Newton's method. Where
/// the widths contradict each other, it does what it can. `motion`: of the shape. `kept`:
/// loads, e.g. that of the measure.
template <int dim>
std::vector<double> widening(const DeformationSpace<dim>& space, const BoundaryMotion<dim>& motion,
                             const std::vector<Width<dim>>& widths,
                             const std::vector<std::vector<double>>& kept);

}  // namespace wheelwright
