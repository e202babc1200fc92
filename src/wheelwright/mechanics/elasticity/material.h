#pragma once

#include <optional>

#include "wheelwright/mechanics/elasticity/fatigue_strength.h"
#include "wheelwright/mechanics/elasticity/loss_factor.h"

namespace wheelwright {

/// The quantity that is zero along the axle when dim = 2.
enum class Plane {
  strain,  ///< the strain: a wheel that is wide compared with its thickness
  stress,  ///< the stress: a wheel cut from sheet
};

/// Isotropic linear elasticity (2). When dim = 2, in plane strain or plane stress, and nothing else knows
/// which: the law in the plane is the same for both, with the constants of plane_strain_equivalent().
struct Material {
  double youngs_modulus = 200e6;                   ///< E [Pa]
  double poissons_ratio = 0.48;                    ///< nu, 0 <= nu < 1/2
  Plane plane = Plane::strain;                     ///< must be strain when dim = 3
  std::optional<double> density = {};              ///< [kg/m^3]; needed for the mass and for rotation
  std::optional<LossFactor> loss_factor = {};      ///< for the rolling resistance
  std::optional<FatigueStrength> fatigue = {};     ///< what it bears over many turns
  std::optional<double> conductivity = {};         ///< thermal [W/(m K)]; for temperatures
  std::optional<double> maximum_temperature = {};  ///< up to which it may be used [deg C]

  /// The material that has the same in-plane stresses in plane strain: itself, or for plane stress E' = E (1
  /// + 2 nu) / (1 + nu)^2 and nu' = nu / (1 + nu).
  Material plane_strain_equivalent() const {
    if (plane == Plane::strain) return *this;
    const double nu = poissons_ratio;
    return {youngs_modulus * (1 + 2 * nu) / ((1 + nu) * (1 + nu)),
            nu / (1 + nu),
            Plane::strain,
            density,
            loss_factor,
            fatigue,
            conductivity,
            maximum_temperature};
  }

  /// Lame's parameters of the law sigma = lambda tr(eps) I + 2 mu eps in the model's dimension [Pa]. In plane
  /// stress lambda is E nu / (1 - nu^2).
  double lambda() const {
    const Material strained = plane_strain_equivalent();
    const double e = strained.youngs_modulus, nu = strained.poissons_ratio;
    return e * nu / ((1 + nu) * (1 - 2 * nu));
  }
  double mu() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }

  /// E* of Hertz's theory [Pa]: E / (1 - nu^2) in plane strain, E in plane stress.
  double contact_modulus() const {
    const Material strained = plane_strain_equivalent();
    return strained.youngs_modulus / (1 - strained.poissons_ratio * strained.poissons_ratio);
  }

  /// The modulus by which the contact parameter, the ghost penalty and the functionals are scaled [Pa]: E in
  /// plane strain, E' in plane stress.
  double scaling_modulus() const { return plane_strain_equivalent().youngs_modulus; }

  /// Whether nu is so close to 1/2 that elements that lock are of no use, and that lambda is too large for
  /// terms that only stabilize. In plane stress nu / (1 + nu) counts, which is never near 1/2.
  bool nearly_incompressible() const { return plane_strain_equivalent().poissons_ratio > 0.485; }

  /// sigma_33 / (sigma_11 + sigma_22) and eps_33 / (eps_11 + eps_22), with 3 along the axle, when dim = 2.
  double axial_stress_ratio() const { return plane == Plane::strain ? poissons_ratio : 0; }
  double axial_strain_ratio() const {
    return plane == Plane::strain ? 0 : -poissons_ratio / (1 - poissons_ratio);
  }

  bool operator==(const Material&) const = default;
};

}  // namespace wheelwright
