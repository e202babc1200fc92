#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// J_p1 (60): int over the annulus Gamma_C^epsilon of L/(2 E epsilon) |sigma(u)n - p_mean|^2, n radial. The
/// annulus is the tread of the model. Its TreadGrid::annulus_points must not be 0.
template <int dim>
class UniformityAnnulus : public Functional<dim> {
 public:
  /// `length`: the characteristic length L [m]; the paper takes epsilon.
  explicit UniformityAnnulus(double length) : length_(length) {}

  std::string name() const override { return "uniformity_annulus"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  double length_;
};

}  // namespace wheelwright
