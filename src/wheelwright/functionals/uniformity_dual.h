#pragma once

#include "wheelwright/functionals/functional.h"
#include "wheelwright/rolling/neumann_to_dirichlet.h"

namespace wheelwright {

/// J_p2 (61), (71): half the squared H^-1/2 norm of sigma(u)n - p_mean on Gamma_C, by the work of the
/// traction on its Neumann-to-Dirichlet image.
template <int dim>
class UniformityDual : public Criterion<dim> {
 public:
  explicit UniformityDual(std::shared_ptr<const NeumannToDirichlet<dim>> image) : image_(std::move(image)) {}

  std::string name() const override { return std::string(wheelwright::name(Quantity::uniformity_dual)); }
  CriterionTerm evaluate(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                         const Matrix& mean) const override;

 private:
  std::shared_ptr<const NeumannToDirichlet<dim>> image_;
};

/// sigma(u)n - p_mean at the tread's points: dim rows a point, in the layout of
/// RollingSolution::observations.
template <int dim>
Matrix traction_deviation(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                          const Matrix& mean);

}  // namespace wheelwright
