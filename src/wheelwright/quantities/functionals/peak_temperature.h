#pragma once

#include "wheelwright/mechanics/heat/steady_temperature.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

/// The highest steady temperature of the rolling wheel [deg C], or that of a part of the ring: the coldest
/// temperature that it can have, Cooling::coldest(), plus a p-norm over the material of what lies above it,
/// with the correction of the peak von Mises stress. The model must have temperatures. NaN if the conduction
/// cannot be solved.
template <int dim>
class PeakTemperature : public Functional<dim> {
 public:
  explicit PeakTemperature(const std::optional<PartOfRing>& part = {}, PeakNorm norm = {})
      : part_(part), norm_(norm) {}

  std::string name() const override { return of_part("peak_temperature", part_); }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  /// A turn has all positions.
  bool is_mirror_symmetric(MirrorPlane plane) const override { return plane == MirrorPlane::width; }

 private:
  class Excess;

  std::optional<PartOfRing> part_;
  PeakNorm norm_;
};

}  // namespace wheelwright
