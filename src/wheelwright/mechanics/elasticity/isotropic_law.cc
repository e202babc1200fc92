#include "wheelwright/mechanics/elasticity/isotropic_law.h"

#include "wheelwright/mechanics/elasticity/von_mises.h"

namespace wheelwright {
namespace {

template <int dim>
Voigt<dim> at_point(const StrainRows<dim>& strains, size_t i) {
  Voigt<dim> strain;
  for (int k = 0; k < n_strains<dim>; ++k) strain[k] = strains[k][i];
  return strain;
}

}  // namespace

template <int dim>
IsotropicLaw<dim>::IsotropicLaw(const Material& material)
    : material_(material), lambda_(material.lambda()), mu_(material.mu()) {}

template <int dim>
void IsotropicLaw<dim>::stress(const StrainRows<dim>& strains, const StressRows<dim>& stresses) const {
  const double lambda = lambda_, mu = mu_;
  for (size_t i = 0; i < strains[0].size(); ++i) {
    double trace = 0;
    for (int d = 0; d < dim; ++d) trace += strains[d][i];
    for (int s = 0; s < n_strains<dim>; ++s)
      stresses[s][i] = s < dim ? lambda * trace + 2 * mu * strains[s][i] : mu * strains[s][i];
  }
}

template <int dim>
Voigt<dim> IsotropicLaw<dim>::stress_at(const Voigt<dim>& strain) const {
  Voigt<dim> result;
  IsotropicLaw::stress(one_strain<dim>(strain), one_stress<dim>(result));
  return result;
}

template <int dim>
void IsotropicLaw<dim>::tangent(const StrainRows<dim>& strains, const TangentRows<dim>& tangents) const {
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int l = 0; l < n_strains<dim>; ++l) {
      const double shared = k < dim && l < dim ? lambda_ : 0, own = k == l ? (k < dim ? 2 * mu_ : mu_) : 0;
      for (size_t i = 0; i < strains[0].size(); ++i) tangents[k][l][i] = shared + own;
    }
}

template <int dim>
void IsotropicLaw<dim>::energy_density(const StrainRows<dim>& strains, std::span<double> densities) const {
  const double lambda = lambda_, mu = mu_;
  for (size_t i = 0; i < densities.size(); ++i) {
    double trace = 0, squares = 0;
    for (int d = 0; d < dim; ++d) trace += strains[d][i];
    for (int k = 0; k < n_strains<dim>; ++k) squares += (k < dim ? 1 : 0.5) * strains[k][i] * strains[k][i];
    densities[i] = 0.5 * lambda * trace * trace + mu * squares;
  }
}

template <int dim>
void IsotropicLaw<dim>::squared_von_mises(const StrainRows<dim>& strains, std::span<double> squares) const {
  const double factor = 6 * mu_ * mu_, axial = material_.axial_strain_ratio();
  for (size_t i = 0; i < squares.size(); ++i)
    squares[i] = factor * SquaredDeviator<dim>(at_point<dim>(strains, i).data(), axial).value;
}

template <int dim>
void IsotropicLaw<dim>::squared_von_mises_slope(const StrainRows<dim>& strains,
                                                const StressRows<dim>& slopes) const {
  const double factor = 6 * mu_ * mu_, axial = material_.axial_strain_ratio();
  for (size_t i = 0; i < strains[0].size(); ++i) {
    const Voigt<dim> strain = at_point<dim>(strains, i),
                     slope = SquaredDeviator<dim>(strain.data(), axial).by_strain();
    for (int k = 0; k < n_strains<dim>; ++k) slopes[k][i] = factor * slope[k];
  }
}

template <int dim>
void IsotropicLaw<dim>::along_axle(const StrainRows<dim>& strains, std::span<double> axial_stresses,
                                   std::span<double> axial_strains) const {
  const double stress_by_trace = material_.axial_stress_ratio() * 2 * (lambda_ + mu_),
               strain_by_trace = material_.axial_strain_ratio();
  for (size_t i = 0; i < strains[0].size(); ++i) {
    const double trace = strains[0][i] + strains[1][i];
    axial_stresses[i] = stress_by_trace * trace;
    axial_strains[i] = strain_by_trace * trace;
  }
}

template class IsotropicLaw<2>;
template class IsotropicLaw<3>;

}  // namespace wheelwright
