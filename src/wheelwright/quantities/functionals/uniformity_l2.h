#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// The naive uniformity functional (4): int_Gamma_C L/(2E) |sigma(u)n - p_mean|^2. Not continuous in the data
/// of the problem; for comparison.
template <int dim>
class UniformityL2 : public Functional<dim> {
 public:
  /// `length`: the characteristic length L [m].
  explicit UniformityL2(double length) : length_(length) {}

  std::string name() const override { return "uniformity_l2"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  double length_;
};

}  // namespace wheelwright
