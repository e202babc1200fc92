#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "wheelwright/mechanics/equilibrium/ring_forms.h"

namespace wheelwright {

/// Below this stretch the stress of Saint Venant and Kirchhoff's material falls as it is compressed further:
/// the derivative of the force 1/2 E (l^3 - l) of a bar is 0 at l = 1 / sqrt(3).
inline const double softening_stretch = 1 / std::sqrt(3.0);

/// The smallest principal stretch of that material at the quadrature points of a deformed ring; empty if
/// there is no such material.
template <int dim>
std::optional<double> smallest_stretch_of_saint_venant(const RingForms<dim>& forms,
                                                       const std::vector<double>& v);

}  // namespace wheelwright
