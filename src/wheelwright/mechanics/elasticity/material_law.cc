#include "wheelwright/mechanics/elasticity/material_law.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {
namespace {

/// The tangent at one strain.
template <int dim>
Matrix tangent_at(const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
  Matrix result(n_strains<dim>, n_strains<dim>);
  TangentRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int l = 0; l < n_strains<dim>; ++l) rows[k][l] = {&result(k, l), 1};
  law.tangent(one_strain<dim>(strain), rows);
  return result;
}

}  // namespace

template <int dim>
double MaterialLaw<dim>::contact_modulus() const {
  const Matrix d = tangent_at<dim>(*this, {});
  return d(0, 0) - d(0, 1) * d(1, 0) / d(1, 1);
}

template <int dim>
std::optional<std::string> fault_of_linear_law(const MaterialLaw<dim>& law) {
  constexpr double rounding = 1e-10;
  if (!law.is_linear()) return "it is not linear";
  const Matrix d = tangent_at<dim>(law, {});
  double largest = 0;
  for (const double x : d.entries()) largest = std::max(largest, std::abs(x));
  const auto differ = [&](double a, double b) { return !(std::abs(a - b) <= rounding * largest); };
  for (int l = 0; l < n_strains<dim>; ++l) {
    Voigt<dim> strain{};
    strain[l] = 1;
    const Voigt<dim> sigma = stress<dim>(law, strain);
    double energy = 0;
    law.energy_density(one_strain<dim>(strain), {&energy, 1});
    for (int k = 0; k < n_strains<dim>; ++k) {
      if (differ(d(k, l), d(l, k))) return "its tangent is not symmetric";
      if (differ(sigma[k], d(k, l))) return "its stress is not its tangent times the strain";
    }
    if (differ(2 * energy, d(l, l))) return "its energy density is not half of stress times strain";
  }
  Matrix factor = d;
  if (!cholesky(factor)) return "its tangent is not positive definite";
  return {};
}

template class MaterialLaw<2>;
template decltype(fault_of_linear_law<2>) fault_of_linear_law<2>;
template class MaterialLaw<3>;
template decltype(fault_of_linear_law<3>) fault_of_linear_law<3>;

}  // namespace wheelwright
