#pragma once

#include "wheelwright/mechanics/state/turn_losses.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"

namespace wheelwright {

/// The sum of resistance_of_layers() over the harmonics and the layers, or those in a part of the ring.
template <int dim>
class RollingResistance : public Functional<dim> {
 public:
  explicit RollingResistance(const RollingModel<dim>& model, std::optional<PartOfRing> part = {});

  std::string name() const override { return of_part("rolling_resistance", part_); }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  /// A turn has all positions.
  bool is_mirror_symmetric(MirrorPlane plane) const override { return plane == MirrorPlane::width; }

 private:
  std::optional<PartOfRing> part_;
  std::vector<LossFactor> of_layers_;
  LossFactor of_all_;  ///< of all strain energy, from which those of layers may differ
};

}  // namespace wheelwright
