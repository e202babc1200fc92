#pragma once

namespace wheelwright {

/// Isotropic linear elasticity (2); plane strain when dim = 2.
struct Material {
  double youngs_modulus = 200e6;  ///< E [Pa]
  double poissons_ratio = 0.48;   ///< nu, 0 <= nu < 1/2

  double lambda() const {
    return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }
  double mu() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }

  /// E / (1 - nu^2) [Pa], the modulus E* of plane-strain contact.
  double plane_strain_modulus() const { return youngs_modulus / (1 - poissons_ratio * poissons_ratio); }

  bool operator==(const Material&) const = default;
};

}  // namespace wheelwright
