#pragma once

#include <memory>

#include "wheelwright/mechanics/heat/temperature_field.h"
#include "wheelwright/mechanics/state/turn_losses.h"

namespace wheelwright {

// The heat of the losses of a rolling wheel. A material point goes through the same in every turn, and turns
// are short compared with the time in which a wheel warms up: the source is the mean over a turn, which is
// the same in all sectors. All positions of the sector must have been solved.

/// The speed of the axle along the ground [m/s], from the angular speed of the model.
template <int dim>
double rolling_speed(const RollingModel<dim>& model) {
  return model.distributed.angular_speed * model.grid.outer_radius;
}

/// The heat released in one sector, int q N_a of the shape function of every node [W, per metre of width when
/// dim = 2].
template <int dim>
std::vector<double> heat_loads(const StateSolver<dim>& solver, const State<dim>& state);

/// The densities of an integral of the heat q times a weight over one sector, in one layer of the model.
template <int dim>
class WeightedHeat : public MaterialDensity<dim> {
 public:
  WeightedHeat(const RollingModel<dim>& model, int layer,
               std::shared_ptr<const TemperatureField<dim>> weight);

  Matrix densities(const StrainsInCell<dim>& cell) const override;
  Matrix slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const override;
  bool covers(const PolarGrid<dim>& grid, int row) const override { return losses_.covers(grid, row); }

 private:
  /// Multiplies values at the points of a cell, equally many columns of each.
  Matrix weighted(const StrainsInCell<dim>& cell, Matrix values) const;

  LossDensity<dim> losses_;
  double heat_by_force_;  ///< q by the density of the force
  std::shared_ptr<const TemperatureField<dim>> weight_;
};

}  // namespace wheelwright
