#pragma once

#include "wheelwright/mechanics/state/functional_derivative.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

// How close the material is to its fatigue limit: the utilization is the measure of FatigueStrength by its
// limit, at least 0, and 0 in materials of unknown strength. All positions of the sector must have been
// solved: the load cases of a point are the samples of its turn.

/// Whether the fatigue strength of every material is known, or that of a part of the ring.
template <int dim>
bool has_fatigue_strength(const Materials<dim>& materials);

/// The utilization at a point.
template <int dim>
double fatigue_utilization(const StrainsAtPoint<dim>& point);

/// A power of the samples of the utilization, one per load case, the largest of which is the utilization.
template <int dim>
class UtilizationPower : public MaterialDensity<dim> {
 public:
  UtilizationPower(Materials<dim> materials, int exponent, std::optional<PartOfRing> part)
      : materials_(std::move(materials)), exponent_(exponent), part_(std::move(part)) {}

  void densities(const StrainsAtPoint<dim>& point, std::span<double> values) const override;
  void slopes(const StrainsAtPoint<dim>& point, std::span<const double> factors,
              const StressRows<dim>& slopes) const override;
  bool covers(const PolarGrid<dim>& grid, int row) const override;

 private:
  Materials<dim> materials_;
  int exponent_;
  std::optional<PartOfRing> part_;
};

/// The largest utilization in the whole ring, or in a part of it: a p-norm over the material and the turn, as
/// the peak von Mises stress.
template <int dim>
class FatigueUtilization : public Functional<dim> {
 public:
  explicit FatigueUtilization(const Materials<dim>& materials, const std::optional<PartOfRing>& part = {},
                              PeakNorm norm = {})
      : norm_(norm), part_(part), power_(materials, norm.exponent, part) {}

  std::string name() const override { return of_part("fatigue_utilization", part_); }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  /// A turn has all positions.
  bool is_mirror_symmetric(MirrorPlane plane) const override { return plane == MirrorPlane::width; }

 private:
  PeakNorm norm_;
  std::optional<PartOfRing> part_;
  UtilizationPower<dim> power_;
};

}  // namespace wheelwright
