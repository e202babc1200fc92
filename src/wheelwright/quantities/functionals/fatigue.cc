#include "wheelwright/quantities/functionals/fatigue.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> FatigueUtilization<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                       const State<dim>& state, const Matrix&) const {
  double integral = 0, peak = 0;
  for_each_cell<dim>(solver, state, power_, [&](const StrainedCell<dim>& cell) {
    std::vector<double> powers(cell.strains.rows());
    for (int q = 0; q < cell.n_points(); ++q) {
      peak = std::max(peak, fatigue_utilization(cell.at(q)));
      power_.densities(cell.at(q), powers);
      integral += cell.weights[q] * std::accumulate(powers.begin(), powers.end(), 0.0);
    }
  });
  FunctionalValue<dim> value;
  const double norm = norm_.value(peak, integral, 1).peak();
  value.over_positions = norm;
  const double factor = integral > 0 ? norm / (norm_.exponent * integral) : 0;
  value.derivative.integrals.push_back({&power_, std::vector<double>(state.positions().size(), factor)});
  return value;
}

template class FatigueUtilization<2>;
template class FatigueUtilization<3>;

}  // namespace wheelwright
