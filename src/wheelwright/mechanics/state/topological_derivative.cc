#include "wheelwright/mechanics/state/topological_derivative.h"

#include <cmath>
#include <numbers>

#include "wheelwright/mechanics/elasticity/small_hole.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

template <std::size_t n>
double product(const std::array<double, n>& stress, const std::array<double, n>& strain) {
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += stress[k] * strain[k];
  return sum;
}

}  // namespace

template <int dim>
double work_on_small_hole(const MaterialLaw<dim>& law, const Voigt<dim>& strain_u,
                          const Voigt<dim>& strain_p) {
  const Voigt<dim> sigma = stress<dim>(law, strain_p);
  if constexpr (dim == 2)
    if (const OrthotropicMaterial* material = law.orthotropic())
      return product(sigma, strain_of_hole(*material, strain_u));
  return product(sigma, strain_of_hole<dim>(*law.isotropic(), strain_u));
}

namespace {

/// sum of factor_j M_j.
double weighted_sum(const MaterialDensity<2>& density, const StrainsAtPoint<2>& point,
                    std::span<const double> factors) {
  std::vector<double> values(point.n_cases());
  density.densities(point, values);
  double sum = 0;
  for (int j = 0; j < point.n_cases(); ++j) sum += factors[j] * values[j];
  return sum;
}

Voigt<2> strain_in(const StrainsAtPoint<2>& point, int load_case) {
  return {point.strains[0][load_case], point.strains[1][load_case], point.strains[2][load_case]};
}

double product(const Matrix& slopes, const Matrix& strains) {
  double sum = 0;
  for (std::size_t i = 0; i < slopes.entries().size(); ++i) sum += slopes.entries()[i] * strains.entries()[i];
  return sum;
}

}  // namespace

/// The integrand falls as the fourth power of the distance r: with t = 1 / r^2 it is smooth, and so it is in
/// the angle, of which half a turn is enough.
double removed_density(const MaterialDensity<2>& density, const StrainsAtPoint<2>& point,
                       std::span<const double> factors) {
  constexpr int n_radii = 8, n_angles = 32;
  const Material& material = *point.law.isotropic();
  const int n_cases = point.n_cases();
  Matrix slopes(n_cases, n_strains<2>), added(n_cases, n_strains<2>), all(n_cases, n_strains<2>),
      opening(n_cases, n_strains<2>);
  density.slopes(point, factors, stress_columns<2>(slopes, 0));
  const double value = weighted_sum(density, point, factors);
  const auto [points, weights] = gauss_rule(n_radii);
  double sum = 0;
  for (int q = 0; q < n_radii; ++q)
    for (int k = 0; k < n_angles; ++k) {
      const double t = points[q], r = 1 / std::sqrt(t), angle = (k + 0.5) * std::numbers::pi / n_angles;
      for (int j = 0; j < n_cases; ++j) {
        const Voigt<2> strain = strain_in(point, j);
        const Voigt<2> around =
            strain_around_hole(material, strain, {r * std::cos(angle), r * std::sin(angle)});
        for (int i = 0; i < n_strains<2>; ++i) {
          added(j, i) = around[i];
          all(j, i) = strain[i] + around[i];
        }
      }
      const StrainsAtPoint<2> strained{strain_columns<2>(all, 0), point.n_sectors, point.law, point.cell,
                                       point.xi};
      sum += weights[q] / (t * t * n_angles) *
             (weighted_sum(density, strained, factors) - value - product(slopes, added));
    }
  for (int j = 0; j < n_cases; ++j) {
    const Voigt<2> strain = strain_in(point, j), hole = strain_of_hole<2>(material, strain);
    for (int i = 0; i < n_strains<2>; ++i) opening(j, i) = hole[i] - strain[i];
  }
  return sum - value - product(slopes, opening);
}

template decltype(work_on_small_hole<2>) work_on_small_hole<2>;
template decltype(work_on_small_hole<3>) work_on_small_hole<3>;

}  // namespace wheelwright
