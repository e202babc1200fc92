#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "wheelwright/mechanics/elasticity/fatigue_measures.h"
#include "wheelwright/mechanics/elasticity/materials.h"
#include "wheelwright/mechanics/state/functional_derivative.h"

namespace wheelwright {

// How close the material is to its fatigue limit: the utilization is the measure of FatigueStrength by its
// limit, at least 0, and 0 in materials of unknown strength. All positions of the sector must have been
// solved: the load cases of a point are the samples of its turn.

/// Whether the fatigue strength of every material is known.
template <int dim>
bool has_fatigue_strength(const Materials<dim>& materials);

/// The utilization at a point, to whose strains it refers. Samples, and a value, that are less than `least`
/// may be given as 0, which saves time.
template <int dim>
class PointUtilization {
 public:
  explicit PointUtilization(const StrainsAtPoint<dim>& point, double least = 0);

  double value() const;
  /// One per load case: what makes up the largest of them, which is near the value, and depends smoothly on
  /// the strains.
  std::vector<double> samples() const;
  /// The derivative of sum_j factor_j sample_j with respect to the strains. Factors that are 0 cost little.
  void set_slopes(std::span<const double> factors, const StressRows<dim>& slopes) const;

 private:
  const StrainsAtPoint<dim>& point_;
  const FatigueStrength* strength_;
  std::vector<SymmetricTensor> tensors_;
  std::unique_ptr<const MeasuredHistory> measured_;  ///< of the tensors; null of strain energies
  std::vector<double> energies_;
};

/// A power of the samples of the utilization, one per load case. Samples far below a peak count as 0: their
/// powers are negligible.
template <int dim>
class UtilizationPower : public DensityOfHistory<dim> {
 public:
  UtilizationPower(Materials<dim> materials, int exponent, double peak = 0)
      : materials_(std::move(materials)), exponent_(exponent), least_(least_that_counts(peak, exponent)) {}

  /// Of a sample by the peak, so that its power is 1e-12 of that of the peak.
  static double least_that_counts(double peak, int exponent) {
    return peak * std::pow(1e-12, 1.0 / exponent);
  }

  void densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const override;
  void slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                 const StressRows<dim>& slopes) const override;
  /// The rows of materials of known strength.
  bool covers(const PolarGrid<dim>& grid, int row) const override;

 private:
  Materials<dim> materials_;
  int exponent_;
  double least_;
};

}  // namespace wheelwright
