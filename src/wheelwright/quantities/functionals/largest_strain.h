#pragma once

#include "wheelwright/mechanics/state/functional_derivative.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

/// The sum of the p-th powers of the principal strains, the one along the axle included: tr E^p, a smooth
/// function of the strain where principal strains are equal too. At large deformation E is Green's strain.
template <int dim>
class StrainPower : public DensityOfHistory<dim> {
 public:
  /// `exponent`: p, even; of a part of the ring if one is given.
  explicit StrainPower(int exponent, std::optional<PartOfRing> part = {})
      : exponent_(exponent), part_(std::move(part)) {}

  void densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const override;
  void slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                 const StressRows<dim>& slopes) const override;
  bool covers(const PolarGrid<dim>& grid, int row) const override {
    return !part_ || part_->has_row(grid, row);
  }

 private:
  int exponent_;
  std::optional<PartOfRing> part_;
};

/// The largest absolute value of a principal strain at every load position: a p-norm over the material of the
/// whole ring, or of a part of it.
template <int dim>
class LargestStrain : public Functional<dim> {
 public:
  explicit LargestStrain(PeakNorm norm = {}, const std::optional<PartOfRing>& part = {})
      : norm_(norm), part_(part), power_(std::make_shared<const StrainPower<dim>>(norm.exponent, part)) {}

  std::string name() const override { return of_part("largest_strain", part_); }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  PeakNorm norm_;
  std::optional<PartOfRing> part_;
  std::shared_ptr<const StrainPower<dim>> power_;
};

}  // namespace wheelwright
