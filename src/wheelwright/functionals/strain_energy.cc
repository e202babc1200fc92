#include "wheelwright/functionals/strain_energy.h"

namespace wheelwright {

/// dJ_e/dv (59) is the bulk stiffness alone: K v less the ghost penalty and Nitsche's symmetric term.
template <int dim>
CriterionTerm StrainEnergy<dim>::evaluate(const RollingProblem<dim>& problem,
                                          const RollingSolution<dim>& solution, const Matrix&) const {
  return {solution.strain_energy, {1, 1, problem.nitsche_loads(solution.observations)}};
}

template <int dim>
double StrainEnergy<dim>::boundary_density(const Voigt<dim>& strain, const Voigt<dim>& stress) const {
  double work = 0;
  for (int k = 0; k < n_strains<dim>; ++k) work += stress[k] * strain[k];
  return 0.5 * work;
}

template class StrainEnergy<2>;
template class StrainEnergy<3>;

}  // namespace wheelwright
