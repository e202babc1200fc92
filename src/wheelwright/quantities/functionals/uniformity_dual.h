#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// J_p2 (61), (71): half the squared H^-1/2 norm of sigma(u)n - p_mean on Gamma_C, computed as the work of
/// the traction on its Neumann-to-Dirichlet image. Which norm, the operator decides (DualNorm).
template <int dim>
class UniformityDual : public Functional<dim> {
 public:
  using TractionMap = typename StateSolver<dim>::TractionMap;

  /// `neumann_to_dirichlet`: the solver's operator of that name.
  explicit UniformityDual(TractionMap neumann_to_dirichlet)
      : neumann_to_dirichlet_(std::move(neumann_to_dirichlet)) {}

  std::string name() const override { return "uniformity_dual"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  TractionMap neumann_to_dirichlet_;
};

/// sigma(u)n - p_mean at the tread's points: dim rows per point, columns as State::observations().
template <int dim>
Matrix traction_deviation(const TreadSurface<dim>& tread, const State<dim>& state, const Matrix& mean);

}  // namespace wheelwright
