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

FactoredField strains_of_cases(const Matrix& modes, const Matrix& weights, const Matrix& maps) {
  return {transposed(maps), product(modes, Op::transpose, weights, Op::transpose)};
}

template <int dim>
std::vector<double> integrands(const LoadPositions& positions, const StrainsInCell<dim>& cell,
                               std::span<const typename FunctionalDerivative<dim>::Integral> integrals) {
  std::vector<double> sums(cell.n_points(), 0.0);
  for (const auto& [density, factors] : integrals) {
    const Matrix values = density->densities(cell);
    for (int q = 0; q < cell.n_points(); ++q)
      for (int j = 0; j < cell.n_cases(); ++j) {
        const int position = j / cell.n_sectors();
        sums[q] += positions.multiplicities[position] * factors[position] * values(j, q);
      }
  }
  return sums;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                       \
  template decltype(strain_maps<dim>) strain_maps<dim>;                                    \
  template std::vector<double> integrands(const LoadPositions&, const StrainsInCell<dim>&, \
                                          std::span<const FunctionalDerivative<dim>::Integral>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
