#include "wheelwright/functionals/uniformity_dual.h"

#include "wheelwright/functionals/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
Matrix traction_deviation(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                          const Matrix& mean) {
  const Matrix deviation = deviation_from_mean(problem, solution, mean);
  Matrix tractions(dim * static_cast<int>(problem.tread().points().size()), deviation.columns());
  for (int j = 0; j < tractions.columns(); ++j)
    for (int i = 0; i < tractions.rows(); ++i)
      tractions(i, j) = deviation(2 * dim * (i / dim) + dim + i % dim, j);
  return tractions;
}

template <int dim>
CriterionTerm UniformityDual<dim>::evaluate(const RollingProblem<dim>& problem,
                                            const RollingSolution<dim>& solution, const Matrix& mean) const {
  const Matrix tractions = traction_deviation(problem, solution, mean);
  const Matrix image = (*image_)(tractions);
  CriterionTerm term{std::vector<double>(solution.positions.size()),
                     {0, 0, Matrix(solution.observations.rows(), tractions.columns())}};
  for (int j = 0; j < tractions.columns(); ++j) {
    double& value = term.values[j / problem.tread().n_columns()];
    for (int i = 0; i < tractions.rows(); ++i) {
      const double weight = problem.tread().points()[i / dim].weight;
      value += 0.5 * weight * tractions(i, j) * image(i, j);
      term.loads.observations(2 * dim * (i / dim) + dim + i % dim, j) = -weight * image(i, j);  // (72)
    }
  }
  return term;
}

template class UniformityDual<2>;
template class UniformityDual<3>;
template Matrix traction_deviation(const RollingProblem<2>&, const RollingSolution<2>&, const Matrix&);
template Matrix traction_deviation(const RollingProblem<3>&, const RollingSolution<3>&, const Matrix&);

}  // namespace wheelwright
