#pragma once

#include "wheelwright/mechanics/elasticity/material_law.h"
#include "wheelwright/mechanics/elasticity/orthotropic_material.h"

namespace wheelwright {

/// Orthotropic linear elasticity with polar axes.
template <int dim>
class OrthotropicLaw : public MaterialLaw<dim> {
 public:
  /// The material must be stable, and when dim = 3 have all shear moduli.
  explicit OrthotropicLaw(const OrthotropicMaterial& material);

  bool is_linear() const override { return true; }
  bool has_polar_axes() const override { return true; }
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
  const OrthotropicMaterial* orthotropic() const override { return &material_; }

 private:
  using Form = std::array<Voigt<dim>, n_strains<dim>>;

  OrthotropicMaterial material_;
  Form stiffness_;  ///< stress by strain
  Form von_mises_;  ///< the quadratic form of the strain that is the squared von Mises stress
  Voigt<dim> axial_stress_{}, axial_strain_{};  ///< by strain, when dim = 2
};

}  // namespace wheelwright
