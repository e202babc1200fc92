#include "wheelwright/mechanics/rolling/integrands.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
Matrix strain_maps(const ElasticElement<dim>& element,
                   std::span<const typename ElasticElement<dim>::Point> points) {
  Matrix strains(element.n_dofs(), n_strains<dim> * static_cast<int>(points.size()));
  for (size_t q = 0; q < points.size(); ++q)
    for (int k = 0; k < n_strains<dim>; ++k)
      std::copy_n(points[q].strain[k].begin(), element.n_dofs(),
                  strains.column(n_strains<dim> * static_cast<int>(q) + k));
  return strains;
}

template <int dim>
double integrand(const LoadPositions& positions, const StrainsAtPoint<dim>& point,
                 std::span<const typename FunctionalDerivative<dim>::Integral> integrals) {
  std::vector<double> values(point.n_cases());
  double sum = 0;
  for (const auto& [density, factors] : integrals) {
    density->densities(point, values);
    for (int j = 0; j < point.n_cases(); ++j)
      sum += positions.multiplicities[j / point.n_sectors] * factors[j / point.n_sectors] * values[j];
  }
  return sum;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                          \
  template decltype(strain_maps<dim>) strain_maps<dim>;                       \
  template double integrand(const LoadPositions&, const StrainsAtPoint<dim>&, \
                            std::span<const FunctionalDerivative<dim>::Integral>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
