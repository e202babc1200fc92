#pragma once

#include "wheelwright/mechanics/state/functional_derivative.h"
#include "wheelwright/mechanics/state/load_positions.h"

namespace wheelwright {

/// Strains of some points of an element on its dofs, n_strains columns per point.
template <int dim>
Matrix strain_maps(const ElasticElement<dim>& element,
                   std::span<const typename ElasticElement<dim>::Point> points);

/// The strains of all load cases from the modes of a cell's dofs, the weights of the modes in the load cases
/// and strain_maps().
FactoredField strains_of_cases(const Matrix& modes, const Matrix& weights, const Matrix& maps);

/// The places of points of a quadrature in the unit cell.
template <int dim>
std::vector<Vec<dim>> places_of(const auto& points) {
  std::vector<Vec<dim>> places;
  for (const auto& point : points) places.push_back(point.xi);
  return places;
}

/// sum over the load cases of m_j factor_i M(u_j) at the points of a cell.
template <int dim>
std::vector<double> integrands(const LoadPositions& positions, const StrainsInCell<dim>& cell,
                               std::span<const typename FunctionalDerivative<dim>::Integral> integrals);

}  // namespace wheelwright
