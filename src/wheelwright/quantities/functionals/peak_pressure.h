#pragma once

#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/peak_norm.h"

namespace wheelwright {

/// The largest contact pressure at every load position [Pa], as ContactSummary has it: a p-norm over the
/// contact's quadrature points.
template <int dim>
class PeakPressure : public Functional<dim> {
 public:
  explicit PeakPressure(PeakNorm norm = {}) : norm_(norm) {}

  std::string name() const override { return "peak_pressure"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  PeakNorm norm_;
};

}  // namespace wheelwright
