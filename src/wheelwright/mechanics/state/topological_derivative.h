#pragma once

#include "wheelwright/mechanics/state/functional_derivative.h"

namespace wheelwright {

/// A point of the material, in a cell that is full of it.
template <int dim>
struct MaterialPoint {
  int cell;     ///< of the sector's grid
  Vec<dim> xi;  ///< position in the unit cell
};

/// sigma(p) : A eps(u): the work of the adjoint stress on the strain of a small round hole without traction
/// (strain_of_hole()), per its area, or volume when dim = 3. has_small_holes() must be true.
template <int dim>
double work_on_small_hole(const MaterialLaw<dim>& law, const Voigt<dim>& strain_u,
                          const Voigt<dim>& strain_p);

/// Whether strain_of_hole() is known for a law.
template <int dim>
bool has_small_holes(const MaterialLaw<dim>& law) {
  return law.isotropic() || (dim == 2 && law.orthotropic());
}

/// The change of the sum over load cases j of factor_j int M_j dx by a small round traction-free hole, in
/// addition to the contribution of the adjoint problem, per area or volume of the hole: the integral of M(eps
/// + e) - M(eps) - M'(eps) e round the hole, with e = what the hole adds to the strain, less M(eps) and
/// M'(eps) (A eps - eps) of the hole itself (Amstutz and Novotny 2010, for any density). The law must be
/// isotropic.
template <int dim>
double removed_density(const MaterialDensity<dim>& density, const StrainsAtPoint<dim>& point,
                       std::span<const double> factors);

}  // namespace wheelwright
