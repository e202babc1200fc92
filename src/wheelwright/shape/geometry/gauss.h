#pragma once

#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// A Gauss-Legendre rule on [0, 1].
struct GaussRule {
  std::vector<double> points, weights;
};

/// Returns the rule with n points, which is exact for polynomials of degree 2n - 1.
GaussRule gauss_rule(int n);

/// A quadrature point in the unit cell.
template <int dim>
struct ReferencePoint {
  Vec<dim> xi;
  double weight;
};

/// Returns the tensor product of the n-point rule on the unit cell; axis 0 varies fastest.
template <int dim>
std::vector<ReferencePoint<dim>> unit_cell_rule(int n);

}  // namespace wheelwright
