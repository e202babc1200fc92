#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

/// The peak f over the material at every load position, as a p-norm with its derivative. `power`: the density
/// (f / unit)^p. `visit(point, powers, squared_peaks)` sets the densities of all load cases at a point and
/// raises the squares of the peaks, of the positions, to those of f there.
template <int dim, class Visit>
FunctionalValue<dim> peak_over_material(const StateSolver<dim>& solver, const State<dim>& state,
                                        const PeakNorm& norm, double unit,
                                        std::shared_ptr<const MaterialDensity<dim>> power,
                                        const Visit& visit) {
  const int n = state.positions().size();
  struct Sums {
    std::vector<double> integrals, squared_peaks;
  };
  Sums all{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  const StrainedCells<dim> cells(solver, state, *power);
  const auto of_cell = [&](int k) {
    const StrainedCell<dim> cell = cells[k];
    Sums sums{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
    std::vector<double> powers(cell.n_cases());
    for (int q = 0; q < cell.n_points(); ++q) {
      visit(cell.at(q), powers, sums.squared_peaks);
      for (size_t j = 0; j < powers.size(); ++j)
        sums.integrals[j / cell.n_sectors()] += cell.weights[q] * powers[j];
    }
    return sums;
  };
  compute_in_parallel(cells.size(), of_cell, [&](int, const Sums& sums) {
    for (int i = 0; i < n; ++i) {
      all.integrals[i] += sums.integrals[i];
      all.squared_peaks[i] = std::max(all.squared_peaks[i], sums.squared_peaks[i]);
    }
  });
  FunctionalValue<dim> value;
  std::vector<double> factors;
  for (int i = 0; i < n; ++i) {
    const double peak = norm.value(std::sqrt(all.squared_peaks[i]), all.integrals[i], unit).peak();
    value.by_position.push_back(peak);
    factors.push_back(peak / (norm.exponent * all.integrals[i]));
  }
  value.derivative.integrals.push_back({std::move(power), std::move(factors)});
  return value;
}

}  // namespace wheelwright
