#pragma once

#include "wheelwright/mechanics/elasticity/materials.h"
#include "wheelwright/mechanics/state/functional_derivative.h"

namespace wheelwright {

// How close the material is to its fatigue limit: the utilization is the measure of FatigueStrength by its
// limit, at least 0, and 0 in materials of unknown strength. All positions of the sector must have been
// solved: the load cases of a point are the samples of its turn.

/// Whether the fatigue strength of every material is known.
template <int dim>
bool has_fatigue_strength(const Materials<dim>& materials);

/// The utilization at a point.
template <int dim>
double fatigue_utilization(const StrainsAtPoint<dim>& point);

/// A power of the samples of the utilization, one per load case, the largest of which is the utilization.
template <int dim>
class UtilizationPower : public MaterialDensity<dim> {
 public:
  UtilizationPower(Materials<dim> materials, int exponent)
      : materials_(std::move(materials)), exponent_(exponent) {}

  void densities(const StrainsAtPoint<dim>& point, std::span<double> values) const override;
  void slopes(const StrainsAtPoint<dim>& point, std::span<const double> factors,
              const StressRows<dim>& slopes) const override;
  /// The rows of materials of known strength.
  bool covers(const PolarGrid<dim>& grid, int row) const override;

 private:
  Materials<dim> materials_;
  int exponent_;
};

}  // namespace wheelwright
