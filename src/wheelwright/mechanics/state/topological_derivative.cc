#include "wheelwright/mechanics/state/topological_derivative.h"

#include <cmath>
#include <numbers>
#include <numeric>

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

/// The same point under other strains, a block of n_strains columns for each.
StrainsInCell<2> under(const StrainsAtPoint<2>& point, Matrix strains) {
  const int n_points = strains.columns() / n_strains<2>;
  return {
      {transposed(strains)}, point.n_sectors, point.law, point.cell, std::vector<Vec<2>>(n_points, point.xi)};
}

/// sum of factor_j M_j.
std::vector<double> weighted_sums(const MaterialDensity<2>& density, const StrainsInCell<2>& strains,
                                  std::span<const double> factors) {
  const Matrix values = density.densities(strains);
  std::vector<double> sums(values.columns(), 0.0);
  for (int q = 0; q < values.columns(); ++q)
    for (int j = 0; j < values.rows(); ++j) sums[q] += factors[j] * values(j, q);
  return sums;
}

Voigt<2> strain_in(const StrainsAtPoint<2>& point, int load_case) {
  return {point.strains[0][load_case], point.strains[1][load_case], point.strains[2][load_case]};
}

Voigt<2> combined(const Voigt<2>& a, double factor, const Voigt<2>& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// Sets the strain of a load case in one of the blocks of columns.
void set_strain(const Voigt<2>& strain, int load_case, int block, Matrix& strains) {
  for (int k = 0; k < n_strains<2>; ++k) strains(load_case, n_strains<2> * block + k) = strain[k];
}

Matrix strains_of(const StrainsAtPoint<2>& point) {
  Matrix strains(point.n_cases(), n_strains<2>);
  for (int j = 0; j < point.n_cases(); ++j) set_strain(strain_in(point, j), j, 0, strains);
  return strains;
}

/// The product of the slopes and a block of strains.
double product(const Matrix& slopes, const Matrix& strains, int block) {
  const double* of_block = strains.column(n_strains<2> * block);
  return std::inner_product(slopes.entries().begin(), slopes.entries().end(), of_block, 0.0);
}

}  // namespace

/// The integrand falls as the fourth power of the distance r: with t = 1 / r^2 it is smooth, and so it is in
/// the angle, of which half a turn is enough.
double removed_density(const MaterialDensity<2>& density, const StrainsAtPoint<2>& point,
                       std::span<const double> factors) {
  constexpr int n_radii = 8, n_angles = 32;
  const Material& material = *point.law.isotropic();
  const auto [points, weights] = gauss_rule(n_radii);
  Matrix added(point.n_cases(), n_strains<2> * n_radii * n_angles), all = added,
                                                                    opening(point.n_cases(), n_strains<2>);
  for (int j = 0; j < point.n_cases(); ++j) {
    const Voigt<2> strain = strain_in(point, j), hole = strain_of_hole<2>(material, strain);
    for (int k = 0; k < n_radii * n_angles; ++k) {
      const double r = 1 / std::sqrt(points[k / n_angles]),
                   angle = (k % n_angles + 0.5) * std::numbers::pi / n_angles;
      const Voigt<2> around =
          strain_around_hole(material, strain, {r * std::cos(angle), r * std::sin(angle)});
      set_strain(around, j, k, added);
      set_strain(combined(strain, 1, around), j, k, all);
    }
    set_strain(combined(hole, -1, strain), j, 0, opening);
  }
  const StrainsInCell<2> here = under(point, strains_of(point));
  const Matrix slopes = density.slopes(here, factors);
  const double value = weighted_sums(density, here, factors).front();
  const std::vector<double> around = weighted_sums(density, under(point, std::move(all)), factors);
  double sum = 0;
  for (int k = 0; k < n_radii * n_angles; ++k) {
    const double t = points[k / n_angles];
    sum += weights[k / n_angles] / (t * t * n_angles) * (around[k] - value - product(slopes, added, k));
  }
  return sum - value - product(slopes, opening, 0);
}

template decltype(work_on_small_hole<2>) work_on_small_hole<2>;
template decltype(work_on_small_hole<3>) work_on_small_hole<3>;

}  // namespace wheelwright
