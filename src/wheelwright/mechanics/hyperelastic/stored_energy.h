#pragma once

#include <array>

#include "wheelwright/base/vec.h"
#include "wheelwright/mechanics/elasticity/material.h"

namespace wheelwright {

/// The form of a stored energy W(F). All have Hooke's law as their limit for small strains. C = F^T F, E =
/// (C - I)/2, J = det F.
enum class EnergyForm {
  neo_hookean,             ///< mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2
  saint_venant_kirchhoff,  ///< mu E:E + lambda/2 (tr E)^2: for small strains and large rotations
  /// c1 (I_1 - 3) + c2 (I_2 - 3) - (2 c1 + 4 c2) ln J + (lambda - 4 c2)/2 (ln J)^2, with mu = 2 (c1 + c2)
  mooney_rivlin,
  small_strain,  ///< mu e:e + lambda/2 (tr e)^2 with e = sym(F) - I: Hooke's law, for small rotations alone
};

/// Isotropic hyperelasticity. When dim = 2 it is the law in the plane of the wheel, in plane strain or plane
/// stress; only the functions below know which.
struct StoredEnergy {
  EnergyForm form = EnergyForm::neo_hookean;
  double mu, lambda;  ///< Lame's parameters in three dimensions [Pa]
  Plane plane = Plane::strain;
  double second_share = 0;  ///< c2 / (c1 + c2) of Mooney and Rivlin's form, from 0 to 1

  /// With the constants of Hooke's law.
  static StoredEnergy of(const Material& material, EnergyForm form = EnergyForm::neo_hookean,
                         double second_share = 0);

  /// Whether its volumetric part is lambda/2 (ln J)^2, so that a part of lambda can work on a projection of
  /// ln J instead.
  bool has_logarithmic_volume() const {
    return form == EnergyForm::neo_hookean || form == EnergyForm::mooney_rivlin;
  }
  bool operator==(const StoredEnergy&) const = default;
};

/// dP/dF: [dim i + j][dim k + l] is dP_ij / dF_kl; symmetric [Pa].
template <int dim>
using PiolaTangent = std::array<std::array<double, dim * dim>, dim * dim>;

/// The response to a deformation gradient F.
template <int dim>
struct EnergyResponse {
  double energy;              ///< W per undeformed volume [J/m^3]; infinite if J <= 0
  Mat<dim> piola;             ///< first Piola-Kirchhoff stress P = dW/dF [Pa]
  PiolaTangent<dim> tangent;  ///< of P

  /// Across the plane when dim = 2, with 3 along the axle.
  double axial_stretch = 1;  ///< F_33
  double axial_piola = 0;    ///< P_33 [Pa]

  /// Whether the material is not turned inside out, J > 0. If it is, P and its tangent are zero. The form for
  /// small strains does not mind.
  bool admissible = true;
};

/// W, P and dP/dF. In plane stress the stretch across the plane is the one for which P_33 = 0.
///
/// `pressure`: adds pressure * ln J to W in P and its tangent, but not in the energy itself: the part of
/// lambda that works on a projection of ln J [Pa].
template <int dim>
EnergyResponse<dim> response(const StoredEnergy& energy, const Mat<dim>& f, double pressure = 0);

/// Derivatives across the plane with respect to F when dim = 2.
struct AxialSlopes {
  Mat<2> stretch{};  ///< dF_33 / dF_kl; zero in plane strain
  Mat<2> piola{};    ///< dP_33 / dF_kl [Pa]; zero in plane stress
};
AxialSlopes axial_slopes(const StoredEnergy& energy, const Mat<2>& f);

}  // namespace wheelwright
