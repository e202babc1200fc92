#pragma once

#include "wheelwright/mechanics/state/functional_derivative.h"
#include "wheelwright/mechanics/state/load_positions.h"

namespace wheelwright {

/// Strains of some points of an element on its dofs, n_strains columns per point.
template <int dim>
Matrix strain_maps(const ElasticElement<dim>& element,
                   std::span<const typename ElasticElement<dim>::Point> points);

/// sum over the load cases of m_j factor_i M(u_j) at one point.
template <int dim>
double integrand(const LoadPositions& positions, const StrainsAtPoint<dim>& point,
                 std::span<const typename FunctionalDerivative<dim>::Integral> integrals);

}  // namespace wheelwright
