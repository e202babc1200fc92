#pragma once

#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Gauss-Legendre rule on [0, 1].
struct GaussRule {
  std::vector<double> points, weights;
};

/// The rule with n points, exact for polynomials of degree 2n - 1.
GaussRule gauss_rule(int n);

/// A quadrature point in the unit cell.
template <int dim>
struct ReferencePoint {
  Vec<dim> xi;
  double weight;
};

/// Tensor product of the n-point rule over the unit cell.
template <int dim>
std::vector<ReferencePoint<dim>> unit_cell_rule(int n);

}  // namespace wheelwright
