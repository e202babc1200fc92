#pragma once

#include "wheelwright/mechanics/elasticity/material_law.h"

namespace wheelwright {

/// Isotropic linear elasticity (2): sigma = lambda tr(eps) I + 2 mu eps.
template <int dim>
class IsotropicLaw : public MaterialLaw<dim> {
 public:
  explicit IsotropicLaw(const Material& material);

  bool is_linear() const override { return true; }
  void stress(const StrainRows<dim>& strains, const StressRows<dim>& stresses) const override;
  void tangent(const StrainRows<dim>& strains, const TangentRows<dim>& tangents) const override;
  void energy_density(const StrainRows<dim>& strains, std::span<double> densities) const override;
  void squared_von_mises(const StrainRows<dim>& strains, std::span<double> squares) const override;
  void squared_von_mises_slope(const StrainRows<dim>& strains, const StressRows<dim>& slopes) const override;
  void along_axle(const StrainRows<dim>& strains, std::span<double> axial_stresses,
                  std::span<double> axial_strains) const override;
  double scaling_modulus() const override { return material_.scaling_modulus(); }
  double contact_modulus() const override { return material_.contact_modulus(); }
  std::optional<double> density() const override { return material_.density; }
  std::optional<LossFactor> loss_factor() const override { return material_.loss_factor; }
  std::optional<double> conductivity() const override { return material_.conductivity; }
  std::optional<double> maximum_temperature() const override { return material_.maximum_temperature; }
  const FatigueStrength* fatigue_strength() const override {
    return material_.fatigue ? &*material_.fatigue : nullptr;
  }
  const Material* isotropic() const override { return &material_; }

 private:
  /// Its own stress, whatever a derived class adds.
  Voigt<dim> stress_at(const Voigt<dim>& strain) const;

  Material material_;
  double lambda_, mu_;
};

/// The stress of isotropic linear elasticity at one point.
template <int dim>
Voigt<dim> stress(const Material& material, const Voigt<dim>& strain) {
  return stress<dim>(IsotropicLaw<dim>(material), strain);
}

}  // namespace wheelwright
