#include "wheelwright/mechanics/state/functional_derivative.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace wheelwright {
namespace {

/// sum += factor_i term_i, where an empty vector is zero.
void accumulate(const std::vector<double>& factors, const std::vector<double>& term,
                std::vector<double>& sum) {
  if (term.empty()) return;
  sum.resize(term.size(), 0.0);
  for (std::size_t i = 0; i < term.size(); ++i) sum[i] += factors[i] * term[i];
}

/// The same of columns, equally many per position; an empty matrix is zero.
void accumulate(const std::vector<double>& factors, const Matrix& term, Matrix& sum) {
  if (term.columns() == 0) return;
  if (sum.columns() == 0) sum = Matrix(term.rows(), term.columns());
  const int per_position = term.columns() / static_cast<int>(factors.size());
  for (int j = 0; j < term.columns(); ++j)
    for (int i = 0; i < term.rows(); ++i) sum(i, j) += factors[j / per_position] * term(i, j);
}

/// The same of the rim's motions.
void accumulate(const std::vector<double>& factors, const std::vector<RimForce>& term,
                std::vector<RimForce>& sum) {
  if (term.empty()) return;
  sum.resize(term.size());
  for (std::size_t i = 0; i < term.size(); ++i)
    sum[i] = wheelwright::sum(sum[i], scaled(factors[i], term[i]));
}

/// The same of the tractions at every position's points.
template <int dim>
void accumulate(const std::vector<double>& factors, const std::vector<std::vector<Vec<dim>>>& term,
                std::vector<std::vector<Vec<dim>>>& sum) {
  if (term.empty()) return;
  sum.resize(term.size());
  for (std::size_t i = 0; i < term.size(); ++i) {
    sum[i].resize(term[i].size(), Vec<dim>{});
    for (std::size_t q = 0; q < term[i].size(); ++q)
      for (int d = 0; d < dim; ++d) sum[i][q][d] += factors[i] * term[i][q][d];
  }
}

template <int dim>
Voigt<dim> strain_of(const StrainsAtPoint<dim>& point, int load_case) {
  Voigt<dim> strain;
  for (int k = 0; k < n_strains<dim>; ++k) strain[k] = point.strains[k][load_case];
  return strain;
}

}  // namespace

template <int dim>
Matrix sum_of_slopes(std::span<const typename FunctionalDerivative<dim>::Integral> integrals,
                     const StrainsInCell<dim>& cell) {
  Matrix sum(cell.n_cases(), n_strains<dim> * cell.n_points());
  std::vector<double> of_case(cell.n_cases());
  for (const auto& [density, factors] : integrals) {
    for (int j = 0; j < cell.n_cases(); ++j) of_case[j] = factors[j / cell.n_sectors()];
    const Matrix slopes = density->slopes(cell, of_case);
    for (std::size_t i = 0; i < slopes.entries().size(); ++i) sum.data()[i] += slopes.data()[i];
  }
  return sum;
}

template <int dim>
void add(const FunctionalDerivative<dim>& term, const std::vector<double>& factors,
         FunctionalDerivative<dim>& sum) {
  accumulate(factors, term.energy, sum.energy);
  if (!term.energy_by_harmonic.empty()) {
    assert(std::ranges::count(factors, factors.front()) == std::ssize(factors));
    accumulate(std::vector<double>(term.energy_by_harmonic.size(), factors.front()), term.energy_by_harmonic,
               sum.energy_by_harmonic);
  }
  accumulate(factors, term.tread_loads, sum.tread_loads);
  for (const auto& integral : term.integrals) {
    sum.integrals.push_back({integral.density, {}});
    accumulate(factors, integral.factors, sum.integrals.back().factors);
  }
  accumulate(factors, term.rim, sum.rim);
  accumulate<dim>(factors, term.tractions, sum.tractions);
  accumulate(factors, term.growth, sum.growth);
}

template <int dim>
Matrix DensityOfHistory<dim>::densities(const StrainsInCell<dim>& cell) const {
  auto values = Matrix::unfilled(cell.n_cases(), cell.n_points());
  for (int q = 0; q < cell.n_points(); ++q)
    densities_at(cell.at(q), std::span(values.column(q), static_cast<std::size_t>(values.rows())));
  return values;
}

template <int dim>
Matrix DensityOfHistory<dim>::slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const {
  auto values = Matrix::unfilled(cell.n_cases(), n_strains<dim> * cell.n_points());
  for (int q = 0; q < cell.n_points(); ++q)
    slopes_at(cell.at(q), factors, stress_columns<dim>(values, n_strains<dim> * q));
  return values;
}

template <int dim>
void DensityOfStrain<dim>::densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  for (int j = 0; j < point.n_cases(); ++j) values[j] = at(strain_of(point, j), point.law).density;
}

template <int dim>
void DensityOfStrain<dim>::slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                                     const StressRows<dim>& slopes) const {
  for (int j = 0; j < point.n_cases(); ++j) {
    const Voigt<dim> by_strain = at(strain_of(point, j), point.law).by_strain;
    for (int k = 0; k < n_strains<dim>; ++k) slopes[k][j] = factors[j] * by_strain[k];
  }
}

template class DensityOfHistory<2>;
template class DensityOfHistory<3>;
template class DensityOfStrain<2>;
template class DensityOfStrain<3>;
template Matrix sum_of_slopes(std::span<const FunctionalDerivative<2>::Integral>, const StrainsInCell<2>&);
template Matrix sum_of_slopes(std::span<const FunctionalDerivative<3>::Integral>, const StrainsInCell<3>&);
template decltype(add<2>) add<2>;
template decltype(add<3>) add<3>;

}  // namespace wheelwright
