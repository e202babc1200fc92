#pragma once

namespace wheelwright {

/// Isotropic linear elasticity (2); plane strain when dim = 2.
struct Material {
  double youngs_modulus;  ///< E [Pa]
  double poissons_ratio;  ///< nu, 0 <= nu < 1/2

  double lambda() const {
    return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }
  double mu() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
};

}  // namespace wheelwright
