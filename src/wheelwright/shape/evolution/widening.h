#pragma once

#include "wheelwright/shape/evolution/deformation_space.h"
#include "wheelwright/shape/evolution/widths.h"

namespace wheelwright {

/// The deformation of minimum norm under which, to first order, no width is below its minimum and all of
/// `kept`, derivatives of quantities that must not change, are zero: a step of Newton's method. Contradictory
/// widths are satisfied as far as possible. `motion`: of the shape. `kept`: loads, e.g. that of the measure.
template <int dim>
std::vector<double> widening(const DeformationSpace<dim>& space, const BoundaryMotion<dim>& motion,
                             const std::vector<Width<dim>>& widths,
                             const std::vector<std::vector<double>>& kept);

}  // namespace wheelwright
