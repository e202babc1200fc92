#pragma once

#include <array>
#include <span>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// Number of independent components of a symmetric tensor. Their order is (11, 22, 12) or (11, 22, 33, 23,
/// 13, 12); shear strains are engineering strains 2 e_ij.
template <int dim>
constexpr int n_strains = dim*(dim + 1) / 2;

/// A stress or a strain with its components in this order.
template <int dim>
using Voigt = std::array<double, n_strains<dim>>;

/// Strains of a block of points, and stresses or other tensors to be written there: [component][point].
template <int dim>
using StrainRows = std::array<std::span<const double>, n_strains<dim>>;
template <int dim>
using StressRows = std::array<std::span<double>, n_strains<dim>>;

/// Derivatives of stresses with respect to strains, to be written: [component of the stress][component of the
/// strain][point].
template <int dim>
using TangentRows = std::array<StressRows<dim>, n_strains<dim>>;

/// Blocks of one point.
template <int dim>
StrainRows<dim> one_strain(const Voigt<dim>& strain) {
  StrainRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k) rows[k] = {&strain[k], 1};
  return rows;
}
template <int dim>
StressRows<dim> one_stress(Voigt<dim>& stress) {
  StressRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k) rows[k] = {&stress[k], 1};
  return rows;
}

/// A block of the points that stand in the rows of a matrix, with their components in its columns from
/// `first` on.
template <int dim>
StrainRows<dim> strain_columns(const Matrix& strains, int first) {
  StrainRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k)
    rows[k] = {strains.column(first + k), static_cast<size_t>(strains.rows())};
  return rows;
}
template <int dim>
StressRows<dim> stress_columns(Matrix& stresses, int first) {
  StressRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k)
    rows[k] = {stresses.column(first + k), static_cast<size_t>(stresses.rows())};
  return rows;
}

}  // namespace wheelwright
