#pragma once

#include "wheelwright/mechanics/state/functional_derivative.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

/// The p-th power of the von Mises stress in MPa, in the rows of cells that lie wholly farther from the tread
/// than a given distance, and in a part of the ring if one is given.
template <int dim>
class VonMisesPower : public DensityOfHistory<dim> {
 public:
  /// The unit of the stress, which keeps high powers within the range of numbers [Pa].
  static constexpr double unit = 1e6;

  /// `exponent`: p, even; `from_tread`: the distance [m], 0 for all rows.
  VonMisesPower(int exponent, double from_tread, std::optional<PartOfRing> part)
      : exponent_(exponent), from_tread_(from_tread), part_(std::move(part)) {}

  void densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const override;
  void slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                 const StressRows<dim>& slopes) const override;
  bool covers(const PolarGrid<dim>& grid, int row) const override;

 private:
  int exponent_;
  double from_tread_;
  std::optional<PartOfRing> part_;
};

/// The largest von Mises stress at every load position [Pa]: a p-norm over the material of the whole ring.
/// Near the tread the contact's own peak dominates, which the holes hardly change: rows of cells that reach
/// closer to the tread than a given distance are excluded. Of a part of the ring, the norm is only over the
/// part.
template <int dim>
class PeakVonMises : public Functional<dim> {
 public:
  /// `from_tread`: the distance [m]; 0 counts all material.
  explicit PeakVonMises(double from_tread, PeakNorm norm = {}, const std::optional<PartOfRing>& part = {})
      : from_tread_(from_tread),
        norm_(norm),
        part_(part),
        power_(std::make_shared<const VonMisesPower<dim>>(norm.exponent, from_tread, part)) {}

  std::string name() const override;
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  double from_tread_;
  PeakNorm norm_;
  std::optional<PartOfRing> part_;
  std::shared_ptr<const VonMisesPower<dim>> power_;
};

/// Whether a radial row of cells lies at least this far inside the tread, up to rounding.
template <int dim>
bool row_is_inside(const PolarGrid<dim>& grid, int row, double from_tread);

}  // namespace wheelwright
