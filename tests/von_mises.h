#pragma once

#include <cmath>

#include "wheelwright/mechanics/elasticity/isotropic_law.h"

namespace wheelwright::testing {

/// The von Mises stress of a stress in an isotropic material. When dim = 2 the stress along the axle is part
/// of it.
template <int dim>
double von_mises(const Material& material, const Voigt<dim>& s) {
  const double s33 = dim == 2 ? material.axial_stress_ratio() * (s[0] + s[1]) : s[2];
  double shear = 0;
  for (int k = dim; k < n_strains<dim>; ++k) shear += s[k] * s[k];
  const double a = s[0] - s[1], b = s[1] - s33, c = s33 - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
}

}  // namespace wheelwright::testing
