#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// J_e (3), the strain energy.
template <int dim>
class StrainEnergy : public Functional<dim> {
 public:
  std::string name() const override { return "strain_energy"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
};

}  // namespace wheelwright
