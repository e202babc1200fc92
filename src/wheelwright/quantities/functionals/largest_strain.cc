#include "wheelwright/quantities/functionals/largest_strain.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/integer_power.h"
#include "wheelwright/mechanics/elasticity/voigt_indices.h"
#include "wheelwright/mechanics/state/strain_peaks.h"
#include "wheelwright/quantities/functionals/peak_over_material.h"

namespace wheelwright {
namespace {

/// The strain in the plane of the wheel, or in space, of one load case.
template <int dim>
Mat<dim> strain_tensor(const StrainsAtPoint<dim>& point, int load_case) {
  constexpr auto indices = voigt_indices<dim>();
  Mat<dim> e{};
  for (int k = 0; k < n_strains<dim>; ++k) {
    const auto [i, j] = indices[k];
    e[i][j] = e[j][i] = (i == j ? 1 : 0.5) * point.strains[k][load_case];
  }
  return e;
}

template <int dim>
Mat<dim> product(const Mat<dim>& a, const Mat<dim>& b) {
  Mat<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k)
      for (int j = 0; j < dim; ++j) result[i][j] += a[i][k] * b[k][j];
  return result;
}

template <int dim>
Mat<dim> power(Mat<dim> base, int exponent) {
  Mat<dim> result{};
  for (int i = 0; i < dim; ++i) result[i][i] = 1;
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = product<dim>(result, base);
    base = product<dim>(base, base);
  }
  return result;
}

/// Strains along the axle of all load cases; zero in space, where they are among the others.
template <int dim>
std::vector<double> axial_strains(const MaterialLaw<dim>& law, const StrainRows<dim>& strains, int n_cases) {
  std::vector<double> result(n_cases, 0.0), stresses(n_cases);
  if (dim == 2) law.along_axle(strains, stresses, result);
  return result;
}

/// The derivatives of those strains with respect to one component, by central differences: exact for laws
/// that are linear, and to 1e-9 for others.
template <int dim>
std::vector<double> axial_slopes(const StrainsAtPoint<dim>& point, int component) {
  constexpr double step = 1e-5;
  const int n = point.n_cases();
  std::vector<double> result(n);
  for (const double side : {1.0, -1.0}) {
    Matrix moved(n, n_strains<dim>);
    for (int k = 0; k < n_strains<dim>; ++k)
      for (int j = 0; j < n; ++j) moved(j, k) = point.strains[k][j] + (k == component ? side * step : 0);
    const auto axial = axial_strains<dim>(point.law, strain_columns<dim>(moved, 0), n);
    for (int j = 0; j < n; ++j) result[j] += side * axial[j] / (2 * step);
  }
  return result;
}

/// The square of the largest principal strain, if it is more than `so_far`.
template <int dim>
double larger_square(double so_far, const StrainsAtPoint<dim>& point, int load_case, double axial) {
  const Mat<dim> e = strain_tensor<dim>(point, load_case);
  double squares = axial * axial;
  for (int i = 0; i < dim; ++i) squares += dot(e[i], e[i]);
  if (squares <= so_far) return so_far;
  Voigt<dim> strain;
  for (int k = 0; k < n_strains<dim>; ++k) strain[k] = point.strains[k][load_case];
  for (const double principal : principal_strains<dim>(strain.data(), axial))
    so_far = std::max(so_far, principal * principal);
  return so_far;
}

}  // namespace

template <int dim>
void StrainPower<dim>::densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  const auto axial = axial_strains<dim>(point.law, point.strains, point.n_cases());
  for (int j = 0; j < point.n_cases(); ++j) {
    const Mat<dim> e = power<dim>(strain_tensor<dim>(point, j), exponent_);
    values[j] = integer_power(axial[j], exponent_);
    for (int i = 0; i < dim; ++i) values[j] += e[i][i];
  }
}

template <int dim>
void StrainPower<dim>::slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                                 const StressRows<dim>& slopes) const {
  constexpr auto indices = voigt_indices<dim>();
  const int n = point.n_cases();
  for (int j = 0; j < n; ++j) {
    const Mat<dim> e = power<dim>(strain_tensor<dim>(point, j), exponent_ - 1);
    for (int k = 0; k < n_strains<dim>; ++k)
      slopes[k][j] = factors[j] * exponent_ * e[indices[k][0]][indices[k][1]];
  }
  const auto axial = axial_strains<dim>(point.law, point.strains, n);
  if (std::ranges::all_of(axial, [](double e) { return e == 0; })) return;
  for (int k = 0; k < n_strains<dim>; ++k) {
    const auto by_strain = axial_slopes<dim>(point, k);
    for (int j = 0; j < n; ++j)
      slopes[k][j] += factors[j] * exponent_ * integer_power(axial[j], exponent_ - 1) * by_strain[j];
  }
}

template <int dim>
FunctionalValue<dim> LargestStrain<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                  const State<dim>& state, const Matrix&) const {
  const auto visit = [&](const StrainsAtPoint<dim>& point, std::span<double> powers,
                         std::span<double> squared_peaks) {
    power_->densities_at(point, powers);
    const auto axial = axial_strains<dim>(point.law, point.strains, point.n_cases());
    for (int j = 0; j < point.n_cases(); ++j) {
      double& peak = squared_peaks[j / point.n_sectors];
      peak = larger_square<dim>(peak, point, j, axial[j]);
    }
  };
  return peak_over_material<dim>(solver, state, norm_, 1, power_, visit);
}

template class StrainPower<2>;
template class LargestStrain<2>;
template class StrainPower<3>;
template class LargestStrain<3>;

}  // namespace wheelwright
