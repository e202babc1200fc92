#include "wheelwright/quantities/functionals/fatigue.h"

#include <algorithm>

#include "wheelwright/base/integer_power.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> FatigueUtilization<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                       const State<dim>& state, const Matrix&) const {
  struct Sums {
    double integral = 0, peak = 0;
  } all;
  const StrainedCells<dim> cells(solver, state, PowerInPart(*this, 0));
  const auto of_cell = [&](int k) {
    const StrainedCell<dim> cell = cells[k];
    Sums sums{0, all.peak};
    for (int q = 0; q < cell.n_points(); ++q) {
      const StrainsAtPoint<dim> point = cell.at(q);
      const PointUtilization<dim> utilization(
          point, UtilizationPower<dim>::least_that_counts(sums.peak, norm_.exponent));
      sums.peak = std::max(sums.peak, utilization.value());
      for (const double sample : utilization.samples())
        sums.integral += cell.weights[q] * integer_power(sample, norm_.exponent);
    }
    return sums;
  };
  compute_in_parallel(cells.size(), of_cell, [&](int, const Sums& sums) {
    all.integral += sums.integral;
    all.peak = std::max(all.peak, sums.peak);
  });
  FunctionalValue<dim> value;
  const double norm = norm_.value(all.peak, all.integral, 1).peak();
  value.over_positions = norm;
  const double factor = all.integral > 0 ? norm / (norm_.exponent * all.integral) : 0;
  value.derivative.integrals.push_back({std::make_shared<const PowerInPart>(*this, all.peak),
                                        std::vector<double>(state.positions().size(), factor)});
  return value;
}

template class FatigueUtilization<2>;
template class FatigueUtilization<3>;

}  // namespace wheelwright
