#pragma once

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Value, gradient and Hessian of a function at a point, in the orthonormal frame (radial, azimuthal[,
/// axial]) there.
template <int dim>
struct Jet {
  double value;
  Vec<dim> gradient;
  Mat<dim> hessian;
};

/// Value and partial derivatives of a function with respect to radius, azimuth[, width]; of the second ones
/// the lower triangle.
template <int dim>
struct PolarPartials {
  double value = 0;
  Vec<dim> first = {};
  Mat<dim> second = {};
};

/// The jet of a function with these derivatives at this radius.
template <int dim>
Jet<dim> jet(const PolarPartials<dim>& f, double radius) {
  Vec<dim> unit;  // the length of one unit of each coordinate
  for (int i = 0; i < dim; ++i) unit[i] = i == 1 ? radius : 1;
  Jet<dim> result{f.value, {}, {}};
  for (int i = 0; i < dim; ++i) {
    result.gradient[i] = f.first[i] / unit[i];
    for (int j = 0; j <= i; ++j) result.hessian[i][j] = f.second[i][j] / (unit[i] * unit[j]);
  }
  result.hessian[1][0] -= result.gradient[1] / radius;
  result.hessian[1][1] += result.gradient[0] / radius;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < i; ++j) result.hessian[j][i] = result.hessian[i][j];
  return result;
}

/// The derivative of jet() with respect to the radius at fixed partial derivatives.
template <int dim>
Jet<dim> jet_by_radius(const PolarPartials<dim>& f, double radius) {
  const double r2 = radius * radius, r3 = r2 * radius;
  Jet<dim> result{0, {}, {}};
  result.gradient[1] = -f.first[1] / r2;
  result.hessian[1][0] = -f.second[1][0] / r2 + 2 * f.first[1] / r3;
  result.hessian[1][1] = -2 * f.second[1][1] / r3 - f.first[0] / r2;
  if constexpr (dim == 3) result.hessian[2][1] = -f.second[2][1] / r2;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < i; ++j) result.hessian[j][i] = result.hessian[i][j];
  return result;
}

}  // namespace wheelwright
