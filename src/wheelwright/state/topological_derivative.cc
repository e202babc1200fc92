#include "wheelwright/state/topological_derivative.h"

#include <cmath>
#include <numbers>

#include "wheelwright/elasticity/small_hole.h"
#include "wheelwright/geometry/gauss.h"

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
double work_on_small_hole(const Material& material, const Voigt<dim>& strain_u, const Voigt<dim>& strain_p) {
  return product(stress<dim>(material, strain_p), strain_of_hole<dim>(material, strain_u));
}

/// The integrand falls as the fourth power of the distance r: with t = 1 / r^2 it is smooth, and so it is in
/// the angle, of which half a turn is enough.
double removed_density(const MaterialDensity<2>& density, const MaterialLaw<2>& law, const Voigt<2>& strain) {
  constexpr int n_radii = 8, n_angles = 32;
  const Material& material = *law.isotropic();
  const auto [value, slope] = density.at(strain, law);
  const auto [points, weights] = gauss_rule(n_radii);
  double sum = 0;
  for (int q = 0; q < n_radii; ++q)
    for (int k = 0; k < n_angles; ++k) {
      const double t = points[q], r = 1 / std::sqrt(t), angle = (k + 0.5) * std::numbers::pi / n_angles;
      const Voigt<2> added = strain_around_hole(material, strain, {r * std::cos(angle), r * std::sin(angle)});
      Voigt<2> all = strain;
      for (int i = 0; i < n_strains<2>; ++i) all[i] += added[i];
      sum += weights[q] / (t * t * n_angles) * (density.at(all, law).density - value - product(slope, added));
    }
  Voigt<2> opening = strain_of_hole<2>(material, strain);
  for (int i = 0; i < n_strains<2>; ++i) opening[i] -= strain[i];
  return sum - value - product(slope, opening);
}

template double work_on_small_hole<2>(const Material&, const Voigt<2>&, const Voigt<2>&);
template double work_on_small_hole<3>(const Material&, const Voigt<3>&, const Voigt<3>&);

}  // namespace wheelwright
