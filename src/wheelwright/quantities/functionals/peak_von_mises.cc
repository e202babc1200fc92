#include "wheelwright/quantities/functionals/peak_von_mises.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/integer_power.h"
#include "wheelwright/quantities/functionals/peak_over_material.h"

namespace wheelwright {
template <int dim>
void VonMisesPower<dim>::densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  point.law.squared_von_mises(point.strains, values);
  for (double& value : values) value = integer_power(value / (unit * unit), exponent_ / 2);
}

template <int dim>
void VonMisesPower<dim>::slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                                   const StressRows<dim>& slopes) const {
  std::vector<double> squares(point.n_cases());
  point.law.squared_von_mises(point.strains, squares);
  point.law.squared_von_mises_slope(point.strains, slopes);
  for (int j = 0; j < point.n_cases(); ++j) {
    const int half = exponent_ / 2;
    const double slope = half * integer_power(squares[j] / (unit * unit), half - 1);
    for (int k = 0; k < n_strains<dim>; ++k) slopes[k][j] *= factors[j] * slope / (unit * unit);
  }
}

template <int dim>
bool VonMisesPower<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return row_is_inside(grid, row, from_tread_) && (!part_ || part_->has_row(grid, row));
}

template <int dim>
std::string PeakVonMises<dim>::name() const {
  return of_part(from_tread_ > 0 ? "peak_von_mises_inside" : "peak_von_mises", part_);
}

template <int dim>
FunctionalValue<dim> PeakVonMises<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                 const State<dim>& state, const Matrix&) const {
  constexpr double unit = VonMisesPower<dim>::unit;
  const auto visit = [&](const StrainsAtPoint<dim>& point, std::span<double> powers,
                         std::span<double> squared_peaks) {
    point.law.squared_von_mises(point.strains, powers);
    for (size_t j = 0; j < powers.size(); ++j) {
      double& peak = squared_peaks[j / point.n_sectors];
      peak = std::max(peak, powers[j]);
      powers[j] = integer_power(powers[j] / (unit * unit), norm_.exponent / 2);
    }
  };
  return peak_over_material<dim>(solver, state, norm_, unit, power_, visit);
}

template <int dim>
bool row_is_inside(const PolarGrid<dim>& grid, int row, double from_tread) {
  return grid.radius(row + 1) <= grid.outer_radius - from_tread + 1e-9 * grid.row_height(row);
}

template class VonMisesPower<2>;
template class PeakVonMises<2>;
template decltype(row_is_inside<2>) row_is_inside<2>;
template class VonMisesPower<3>;
template class PeakVonMises<3>;
template decltype(row_is_inside<3>) row_is_inside<3>;

}  // namespace wheelwright
