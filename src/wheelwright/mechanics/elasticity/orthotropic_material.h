#pragma once

#include <optional>

#include "wheelwright/mechanics/elasticity/material.h"
#include "wheelwright/mechanics/elasticity/voigt.h"

namespace wheelwright {

/// Normal and shear compliances in the plane of the wheel [1/Pa]: eps_r = rr sigma_r + rt sigma_t, eps_t = rt
/// sigma_r + tt sigma_t, and shear sigma_rt = the engineering shear strain.
struct PlaneCompliance {
  double rr, tt, rt, shear;
};

/// Linear elasticity of a material whose axes of symmetry are, at every point, those of the radius (r), the
/// azimuth (t) and the axle (z). nu_ab is -eps_b / eps_a under a stress along a alone, so that nu_ab / E_a =
/// nu_ba / E_b.
struct OrthotropicMaterial {
  double modulus_r, modulus_t, modulus_z;      ///< Young's moduli [Pa]
  double ratio_rt, ratio_rz, ratio_tz;         ///< Poisson's ratios
  double shear_rt;                             ///< shear moduli [Pa]
  double shear_rz = 0, shear_tz = 0;           ///< do not count when dim = 2
  Plane plane = Plane::strain;                 ///< must be strain when dim = 3
  std::optional<double> density = {};          ///< [kg/m^3]
  std::optional<LossFactor> loss_factor = {};  ///< of all moduli
  std::optional<FatigueStrength> fatigue = {};
  std::optional<double> conductivity = {};  ///< thermal, the same along all axes [W/(m K)]
  std::optional<double> maximum_temperature = {};

  /// The part of the compliance that is free of units and does not depend on the moduli: it has a unit
  /// diagonal, and -coupling beside it. Their squares are nu_ab nu_ba.
  struct Couplings {
    double rt, rz, tz;
  };
  Couplings couplings() const;

  /// 1 - nu_rt nu_tr - nu_rz nu_zr - nu_tz nu_zt - 2 nu_rt nu_tz nu_zr. The strain energy of all strains is
  /// positive if and only if it is and every product of two ratios of a pair of axes is below 1.
  double determinant() const;
  bool is_stable() const;

  /// The least eigenvalue of the compliance that has a unit diagonal: 1 - 2 nu of an isotropic material in
  /// plane strain and in 3D, 1 - nu in plane stress. Displacement elements lock where it is near 0.
  double least_compliance() const;
  /// Whether it is so small that displacement elements lock: that of an isotropic material at nu = 0.485.
  bool locks() const { return least_compliance() < 0.03; }

  /// In plane strain or plane stress; plane strain when dim = 3.
  PlaneCompliance plane_compliance() const;

  /// The stress by the strain in polar axes [Pa], [component of the stress][component of the strain].
  template <int dim>
  std::array<Voigt<dim>, n_strains<dim>> stiffness() const;

  /// sigma_r of a strain eps_r alone [Pa]: lambda + 2 mu of an isotropic material.
  double radial_stiffness() const;

  /// E* of Hertz's theory [Pa], of a half-space whose surface is normal to the radius: 2 / sqrt(s_rr (2
  /// sqrt(s_rr s_tt) + 2 s_rt + s_shear)) with the compliances in the plane (Lekhnitskii 1963).
  double contact_modulus() const;

  /// The modulus by which the contact parameter, the ghost penalty and the functionals are scaled [Pa]: the
  /// geometric mean of E_r and E_t. In plane stress it is made smaller as for an isotropic material whose
  /// Poisson's ratio is the geometric mean of nu_rt and nu_tr.
  double scaling_modulus() const;

  bool operator==(const OrthotropicMaterial&) const = default;
};

template <>
std::array<Voigt<2>, 3> OrthotropicMaterial::stiffness<2>() const;
template <>
std::array<Voigt<3>, 6> OrthotropicMaterial::stiffness<3>() const;

}  // namespace wheelwright
