#pragma once

#include <optional>
#include <string>

#include "wheelwright/mechanics/elasticity/fatigue_strength.h"
#include "wheelwright/mechanics/elasticity/material.h"
#include "wheelwright/mechanics/elasticity/orthotropic_material.h"
#include "wheelwright/mechanics/elasticity/voigt.h"

namespace wheelwright {

/// The response of a material to small strains. It is asked for blocks of points: argument and result hold
/// the components of all points, [component][point], and the same number of points, in the frame of a cell:
/// the first axis is radial at the cell's first azimuth. With has_polar_axes() they are in the axes of every
/// point instead: radial, azimuthal[, axial]. Where dim = 2 it is the law in the plane of the wheel, so that
/// plane strain and plane stress are two laws.
///
/// A law is called by several threads at once. A program that uses the library derives its own law and puts
/// it into RollingModel::materials (examples/own_material).
template <int dim>
class MaterialLaw {
 public:
  virtual ~MaterialLaw() = default;

  /// Whether the stress is a linear function of the strain, zero at zero strain.
  virtual bool is_linear() const = 0;

  /// Whether strains and stresses are in polar axes at every point, and not in the frame of the cell: for a
  /// material whose axes follow the radius. A ring of such a material is the same after every turn.
  virtual bool has_polar_axes() const { return false; }

  /// sigma [Pa].
  virtual void stress(const StrainRows<dim>& strains, const StressRows<dim>& stresses) const = 0;

  /// d sigma / d eps [Pa], with respect to engineering shear strains; symmetric.
  virtual void tangent(const StrainRows<dim>& strains, const TangentRows<dim>& tangents) const = 0;

  /// The strain energy W per volume [J/m^3], zero at zero strain: sigma = dW/d(eps).
  virtual void energy_density(const StrainRows<dim>& strains, std::span<double> densities) const = 0;

  /// The square of the von Mises stress sqrt(3/2 s:s) [Pa^2], with s the stress deviator. The stress along
  /// the axle is part of it.
  virtual void squared_von_mises(const StrainRows<dim>& strains, std::span<double> squares) const = 0;

  /// Its derivative with respect to the strain.
  virtual void squared_von_mises_slope(const StrainRows<dim>& strains,
                                       const StressRows<dim>& slopes) const = 0;

  /// The normal stress [Pa] and strain along the axle. Called if dim = 2 only.
  virtual void along_axle(const StrainRows<dim>& strains, std::span<double> axial_stresses,
                          std::span<double> axial_strains) const = 0;

  /// The modulus by which the contact parameter, the ghost penalty and the functionals are scaled [Pa]: a
  /// Young's modulus for small strains.
  virtual double scaling_modulus() const = 0;

  /// E* of Hertz's theory [Pa], for estimates and starts. By default the ratio of stress and strain of a
  /// body at rest that is pulled along the first axis, free along the second one and held along the third.
  virtual double contact_modulus() const;

  /// [kg/m^3]; needed for the mass and for rotation.
  virtual std::optional<double> density() const { return {}; }

  /// tan(delta), at least 0; needed for the rolling resistance. Of a linear law.
  virtual std::optional<LossFactor> loss_factor() const { return {}; }

  /// Thermal conductivity [W/(m K)], positive, the same along all axes; needed for temperatures.
  virtual std::optional<double> conductivity() const { return {}; }

  /// The temperature [deg C] up to which it may be used.
  virtual std::optional<double> maximum_temperature() const { return {}; }

  /// What it bears over many turns; null if that is unknown. Of a linear law.
  virtual const FatigueStrength* fatigue_strength() const { return nullptr; }

  /// The constants of isotropic linear elasticity; null for other laws. Elements without locking and
  /// derivatives of stresses with respect to small holes are known for isotropic materials only.
  virtual const Material* isotropic() const { return nullptr; }

  /// The constants of orthotropic linear elasticity with polar axes; null for other laws.
  virtual const OrthotropicMaterial* orthotropic() const { return nullptr; }
};

/// The stress at one point.
template <int dim>
Voigt<dim> stress(const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
  Voigt<dim> result;
  law.stress(one_strain<dim>(strain), one_stress<dim>(result));
  return result;
}

/// Why a law cannot be that of a linear model; empty if it can. The law must be linear, its tangent symmetric
/// and positive definite, and stress and energy density must be those of the tangent.
template <int dim>
std::optional<std::string> fault_of_linear_law(const MaterialLaw<dim>& law);

}  // namespace wheelwright
