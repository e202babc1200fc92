#include "wheelwright/functionals/peak_von_mises.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/state/material_integral.h"

namespace wheelwright {
template <int dim>
typename VonMisesPower<dim>::Value VonMisesPower<dim>::at(const Voigt<dim>& strain,
                                                          const MaterialLaw<dim>& law) const {
  double square = 0;
  Value value;
  law.squared_von_mises(one_point<dim>(strain), {&square, 1});
  law.squared_von_mises_slope(one_point<dim>(strain), one_point<dim>(value.by_strain));
  square /= unit * unit;
  const double slope = std::pow(square, exponent_ / 2 - 1);
  value.density = slope * square;
  for (double& x : value.by_strain) x *= exponent_ / 2 * slope / (unit * unit);
  return value;
}

template <int dim>
bool VonMisesPower<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return row_is_inside(grid, row, from_tread_);
}

template <int dim>
std::string PeakVonMises<dim>::name() const {
  return std::string(
      wheelwright::name(from_tread_ > 0 ? Quantity::peak_von_mises_inside : Quantity::peak_von_mises));
}

template <int dim>
FunctionalValue<dim> PeakVonMises<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                 const State<dim>& state, const Matrix&) const {
  constexpr double unit = VonMisesPower<dim>::unit;
  const int n = state.positions().size();
  std::vector<double> integrals(n, 0.0), squared_peaks(n, 0.0);
  for_each_strain<dim>(
      solver, state, power_,
      [&](int position, double weight, const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
        double square = 0;
        law.squared_von_mises(one_point<dim>(strain), {&square, 1});
        squared_peaks[position] = std::max(squared_peaks[position], square);
        integrals[position] += weight * std::pow(square / (unit * unit), norm_.exponent / 2);
      });
  FunctionalValue<dim> value;
  std::vector<double> factors;
  for (int i = 0; i < n; ++i) {
    const auto norm = norm_.value(std::sqrt(squared_peaks[i]), integrals[i], unit);
    value.by_position.push_back(norm.peak());
    factors.push_back(norm.peak() / (norm_.exponent * integrals[i]));
  }
  value.derivative.integrals.push_back({&power_, std::move(factors)});
  return value;
}

template <int dim>
bool row_is_inside(const PolarGrid<dim>& grid, int row, double from_tread) {
  const double height = grid.cell_size()[0];
  const double outer = grid.inner_radius + (row + 1) * height;
  return outer <= grid.outer_radius - from_tread + 1e-9 * height;
}

#define WHEELWRIGHT_INSTANTIATE(dim) \
  template class VonMisesPower<dim>; \
  template class PeakVonMises<dim>;  \
  template bool row_is_inside(const PolarGrid<dim>&, int, double);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
