#pragma once

#include "wheelwright/mechanics/elasticity/material_law.h"
#include "wheelwright/mechanics/hyperelastic/stored_energy.h"

namespace wheelwright {

/// A stored energy as a material law. Its strains are those of Green and Lagrange, E = (F^T F - I)/2, its
/// stresses the second Piola-Kirchhoff stress S = dW/dE, and von Mises stresses are those of Cauchy's stress.
/// Where J would not be positive, stresses are zero and energies infinite.
template <int dim>
class HyperelasticLaw : public MaterialLaw<dim> {
 public:
  explicit HyperelasticLaw(const Material& material, EnergyForm form = EnergyForm::neo_hookean,
                           double second_share = 0)
      : material_(material), energy_(StoredEnergy::of(material, form, second_share)) {}

  const StoredEnergy& stored_energy() const { return energy_; }
  /// The constants of Hooke's law for small strains.
  const Material& small_strains() const { return material_; }

  bool is_linear() const override { return false; }
  void stress(const StrainRows<dim>& strains, const StressRows<dim>& stresses) const override;
  void tangent(const StrainRows<dim>& strains, const TangentRows<dim>& tangents) const override;
  void energy_density(const StrainRows<dim>& strains, std::span<double> densities) const override;
  void squared_von_mises(const StrainRows<dim>& strains, std::span<double> squares) const override;
  void squared_von_mises_slope(const StrainRows<dim>& strains, const StressRows<dim>& slopes) const override;
  /// Cauchy's stress along the axle, and E_33.
  void along_axle(const StrainRows<dim>& strains, std::span<double> axial_stresses,
                  std::span<double> axial_strains) const override;

  double scaling_modulus() const override { return material_.scaling_modulus(); }
  double contact_modulus() const override { return material_.contact_modulus(); }
  std::optional<double> density() const override { return material_.density; }
  std::optional<double> conductivity() const override { return material_.conductivity; }
  std::optional<double> maximum_temperature() const override { return material_.maximum_temperature; }

 private:
  Material material_;
  StoredEnergy energy_;
};

}  // namespace wheelwright
