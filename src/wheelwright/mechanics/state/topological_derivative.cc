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
template <int dim>
StrainsInCell<dim> under(const StrainsAtPoint<dim>& point, Matrix strains) {
  const int n_points = strains.columns() / n_strains<dim>;
  return {{transposed(strains)},
          point.n_sectors,
          point.law,
          point.cell,
          std::vector<Vec<dim>>(n_points, point.xi)};
}

/// sum of factor_j M_j.
template <int dim>
std::vector<double> weighted_sums(const MaterialDensity<dim>& density, const StrainsInCell<dim>& strains,
                                  std::span<const double> factors) {
  const Matrix values = density.densities(strains);
  std::vector<double> sums(values.columns(), 0.0);
  for (int q = 0; q < values.columns(); ++q)
    for (int j = 0; j < values.rows(); ++j) sums[q] += factors[j] * values(j, q);
  return sums;
}

template <int dim>
Voigt<dim> strain_in(const StrainsAtPoint<dim>& point, int load_case) {
  Voigt<dim> strain;
  for (int k = 0; k < n_strains<dim>; ++k) strain[k] = point.strains[k][load_case];
  return strain;
}

template <std::size_t n>
std::array<double, n> combined(std::array<double, n> a, double factor, const std::array<double, n>& b) {
  for (std::size_t k = 0; k < n; ++k) a[k] += factor * b[k];
  return a;
}

/// Sets the strain of a load case in one of the blocks of columns.
template <std::size_t n>
void set_strain(const std::array<double, n>& strain, int load_case, int block, Matrix& strains) {
  for (std::size_t k = 0; k < n; ++k) strains(load_case, static_cast<int>(n * block + k)) = strain[k];
}

template <int dim>
Matrix strains_of(const StrainsAtPoint<dim>& point) {
  Matrix strains(point.n_cases(), n_strains<dim>);
  for (int j = 0; j < point.n_cases(); ++j) set_strain(strain_in(point, j), j, 0, strains);
  return strains;
}

/// The product of the slopes and a block of strains.
double product(const Matrix& slopes, const Matrix& strains, int block) {
  const double* of_block = strains.column(slopes.columns() * block);
  return std::inner_product(slopes.entries().begin(), slopes.entries().end(), of_block, 0.0);
}

/// A point outside of a hole, counted from its centre in units of its radius, and its weight in an integral
/// per area, or volume, of the hole.
template <int dim>
struct PointAround {
  Vec<dim> place;
  double weight;
};

/// A rule for functions that fall as the square of what a hole adds to the strain, and do not change when the
/// place is mirrored in the centre. With t = 1 / r^2, or s = 1 / r when dim = 3, they are smooth, and so they
/// are in the angles, of which one half is enough.
template <int dim>
std::vector<PointAround<dim>> points_around_hole() {
  constexpr int n_radii = 8, n_angles = dim == 2 ? 32 : 16, n_heights = 8;
  const auto [points, weights] = gauss_rule(n_radii);
  std::vector<PointAround<dim>> result;
  for (int k = 0; k < n_radii; ++k)
    if constexpr (dim == 2) {
      const double t = points[k], r = 1 / std::sqrt(t);
      for (int m = 0; m < n_angles; ++m) {
        const double angle = (m + 0.5) * std::numbers::pi / n_angles;
        result.push_back({{r * std::cos(angle), r * std::sin(angle)}, weights[k] / (t * t * n_angles)});
      }
    } else {
      const double s = points[k], r = 1 / s;
      const auto [cosines, shares] = gauss_rule(n_heights);
      for (int h = 0; h < n_heights; ++h)
        for (int m = 0; m < n_angles; ++m) {
          const double angle = 2 * (m + 0.5) * std::numbers::pi / n_angles,
                       along = r * std::sqrt(1 - cosines[h] * cosines[h]);
          result.push_back({{along * std::cos(angle), along * std::sin(angle), r * cosines[h]},
                            3 * weights[k] * shares[h] / (s * s * s * s * n_angles)});
        }
    }
  return result;
}

}  // namespace

template <int dim>
double removed_density(const MaterialDensity<dim>& density, const StrainsAtPoint<dim>& point,
                       std::span<const double> factors) {
  static const std::vector<PointAround<dim>> places = points_around_hole<dim>();
  const int n = static_cast<int>(places.size());
  const Material& material = *point.law.isotropic();
  Matrix added(point.n_cases(), n_strains<dim> * n), all = added, opening(point.n_cases(), n_strains<dim>);
  for (int j = 0; j < point.n_cases(); ++j) {
    const Voigt<dim> strain = strain_in(point, j), hole = strain_of_hole<dim>(material, strain);
    for (int k = 0; k < n; ++k) {
      const Voigt<dim> around = strain_around_hole(material, strain, places[k].place);
      set_strain(around, j, k, added);
      set_strain(combined(strain, 1, around), j, k, all);
    }
    set_strain(combined(hole, -1, strain), j, 0, opening);
  }
  const StrainsInCell<dim> here = under(point, strains_of(point));
  const Matrix slopes = density.slopes(here, factors);
  const double value = weighted_sums(density, here, factors).front();
  const std::vector<double> around = weighted_sums(density, under(point, std::move(all)), factors);
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += places[k].weight * (around[k] - value - product(slopes, added, k));
  return sum - value - product(slopes, opening, 0);
}

template decltype(work_on_small_hole<2>) work_on_small_hole<2>;
template decltype(work_on_small_hole<3>) work_on_small_hole<3>;
template decltype(removed_density<2>) removed_density<2>;
template decltype(removed_density<3>) removed_density<3>;

}  // namespace wheelwright
