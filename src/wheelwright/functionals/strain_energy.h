#pragma once

#include "wheelwright/functionals/functional.h"

namespace wheelwright {

/// J_e (3), the strain energy.
template <int dim>
class StrainEnergy : public Criterion<dim> {
 public:
  std::string name() const override { return std::string(wheelwright::name(Quantity::strain_energy)); }
  CriterionTerm evaluate(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                         const Matrix& mean) const override;
  double boundary_density(const Voigt<dim>& strain, const Voigt<dim>& stress) const override;
};

}  // namespace wheelwright
