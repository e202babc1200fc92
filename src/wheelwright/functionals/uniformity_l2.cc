#include "wheelwright/functionals/uniformity_l2.h"

#include "wheelwright/functionals/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
CriterionTerm UniformityL2<dim>::evaluate(const RollingProblem<dim>& problem,
                                          const RollingSolution<dim>& solution, const Matrix& mean) const {
  const auto& points = problem.tread().points();
  const Matrix deviation = deviation_from_mean(problem, solution, mean);
  const double scale = length_ / problem.model().material.youngs_modulus;
  CriterionTerm term{std::vector<double>(solution.positions.size()),
                     {0, 0, Matrix(deviation.rows(), deviation.columns())}};
  for (int j = 0; j < deviation.columns(); ++j) {
    double& value = term.values[j / problem.tread().n_columns()];
    for (size_t q = 0; q < points.size(); ++q)
      for (int d = 0; d < dim; ++d) {
        const int row = 2 * dim * static_cast<int>(q) + dim + d;
        const double weight = scale * points[q].weight, t = deviation(row, j);
        value += 0.5 * weight * t * t;
        term.loads.observations(row, j) = -weight * t;
      }
  }
  return term;
}

template class UniformityL2<2>;
template class UniformityL2<3>;

}  // namespace wheelwright
