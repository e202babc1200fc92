#include "wheelwright/mechanics/elasticity/orthotropic_law.h"

#include <algorithm>

namespace wheelwright {
namespace {

/// rows = form times the strains, of all points.
template <int dim>
void apply(const std::array<Voigt<dim>, n_strains<dim>>& form, const StrainRows<dim>& strains,
           const StressRows<dim>& rows) {
  for (int k = 0; k < n_strains<dim>; ++k) {
    std::ranges::fill(rows[k], 0.0);
    for (int l = 0; l < n_strains<dim>; ++l) {
      const double factor = form[k][l];
      if (factor == 0) continue;
      for (size_t i = 0; i < strains[l].size(); ++i) rows[k][i] += factor * strains[l][i];
    }
  }
}

/// values = factor times the quadratic form of the strains.
template <int dim>
void square(const std::array<Voigt<dim>, n_strains<dim>>& form, double factor, const StrainRows<dim>& strains,
            std::span<double> values) {
  std::ranges::fill(values, 0.0);
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int l = 0; l < n_strains<dim>; ++l) {
      const double entry = factor * form[k][l];
      if (entry == 0) continue;
      for (size_t i = 0; i < values.size(); ++i) values[i] += entry * strains[k][i] * strains[l][i];
    }
}

/// Adds factor a a^T.
template <int dim>
void add_square(double factor, const Voigt<dim>& a, std::array<Voigt<dim>, n_strains<dim>>& form) {
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int l = 0; l < n_strains<dim>; ++l) form[k][l] += factor * a[k] * a[l];
}

template <int dim>
Voigt<dim> difference(const Voigt<dim>& a, const Voigt<dim>& b) {
  Voigt<dim> result;
  for (int k = 0; k < n_strains<dim>; ++k) result[k] = a[k] - b[k];
  return result;
}

/// values = sum of factor_k strain_k.
template <int dim>
void combine(const Voigt<dim>& factors, const StrainRows<dim>& strains, std::span<double> values) {
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = 0;
    for (int k = 0; k < n_strains<dim>; ++k) values[i] += factors[k] * strains[k][i];
  }
}

}  // namespace

/// The squared von Mises stress is half the sum of the squared differences of the normal stresses, and three
/// times that of the squared shear stresses.
template <int dim>
OrthotropicLaw<dim>::OrthotropicLaw(const OrthotropicMaterial& material)
    : material_(material), stiffness_(material.stiffness<dim>()), von_mises_{} {
  if constexpr (dim == 2) {
    const OrthotropicMaterial& m = material;
    const double by_r = m.ratio_rz / m.modulus_r, by_t = m.ratio_tz / m.modulus_t;
    for (int k = 0; k < 2; ++k) {
      const double contraction = by_r * stiffness_[0][k] + by_t * stiffness_[1][k];
      if (m.plane == Plane::strain)
        axial_stress_[k] = m.modulus_z * contraction;
      else
        axial_strain_[k] = -contraction;
    }
  }
  const Voigt<dim>& axial = dim == 2 ? axial_stress_ : stiffness_[2];
  add_square<dim>(0.5, difference<dim>(stiffness_[0], stiffness_[1]), von_mises_);
  add_square<dim>(0.5, difference<dim>(stiffness_[1], axial), von_mises_);
  add_square<dim>(0.5, difference<dim>(axial, stiffness_[0]), von_mises_);
  for (int k = dim; k < n_strains<dim>; ++k) add_square<dim>(3, stiffness_[k], von_mises_);
}

template <int dim>
void OrthotropicLaw<dim>::stress(const StrainRows<dim>& strains, const StressRows<dim>& stresses) const {
  apply<dim>(stiffness_, strains, stresses);
}

template <int dim>
void OrthotropicLaw<dim>::tangent(const StrainRows<dim>&, const TangentRows<dim>& tangents) const {
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int l = 0; l < n_strains<dim>; ++l) std::ranges::fill(tangents[k][l], stiffness_[k][l]);
}

template <int dim>
void OrthotropicLaw<dim>::energy_density(const StrainRows<dim>& strains, std::span<double> densities) const {
  square<dim>(stiffness_, 0.5, strains, densities);
}

template <int dim>
void OrthotropicLaw<dim>::squared_von_mises(const StrainRows<dim>& strains, std::span<double> squares) const {
  square<dim>(von_mises_, 1, strains, squares);
}

template <int dim>
void OrthotropicLaw<dim>::squared_von_mises_slope(const StrainRows<dim>& strains,
                                                  const StressRows<dim>& slopes) const {
  apply<dim>(von_mises_, strains, slopes);
  for (const auto& component : slopes)
    for (double& x : component) x *= 2;
}

template <int dim>
void OrthotropicLaw<dim>::along_axle(const StrainRows<dim>& strains, std::span<double> axial_stresses,
                                     std::span<double> axial_strains) const {
  combine<dim>(axial_stress_, strains, axial_stresses);
  combine<dim>(axial_strain_, strains, axial_strains);
}

template class OrthotropicLaw<2>;
template class OrthotropicLaw<3>;

}  // namespace wheelwright
