#pragma once

#include "wheelwright/mechanics/state/fatigue_utilization.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

/// The largest utilization in the whole ring, or in a part of it: a p-norm over the material and the turn, as
/// the peak von Mises stress.
template <int dim>
class FatigueUtilization : public Functional<dim> {
 public:
  explicit FatigueUtilization(const Materials<dim>& materials, const std::optional<PartOfRing>& part = {},
                              PeakNorm norm = {})
      : materials_(materials), norm_(norm), part_(part) {}

  std::string name() const override { return of_part("fatigue_utilization", part_); }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  /// A turn has all positions.
  bool is_mirror_symmetric(MirrorPlane plane) const override { return plane == MirrorPlane::width; }

 private:
  class PowerInPart : public UtilizationPower<dim> {
   public:
    PowerInPart(const FatigueUtilization& functional, double peak)
        : UtilizationPower<dim>(functional.materials_, functional.norm_.exponent, peak),
          part_(functional.part_) {}
    bool covers(const PolarGrid<dim>& grid, int row) const override {
      return UtilizationPower<dim>::covers(grid, row) && (!part_ || part_->has_row(grid, row));
    }

   private:
    std::optional<PartOfRing> part_;
  };

  Materials<dim> materials_;
  PeakNorm norm_;
  std::optional<PartOfRing> part_;
};

}  // namespace wheelwright
