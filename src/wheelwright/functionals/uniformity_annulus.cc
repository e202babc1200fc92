#include "wheelwright/functionals/uniformity_annulus.h"

#include "wheelwright/functionals/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
CriterionTerm UniformityAnnulus<dim>::evaluate(const RollingProblem<dim>& problem,
                                               const RollingSolution<dim>& solution,
                                               const Matrix& mean) const {
  const Tread<dim>& tread = problem.tread();
  const auto& points = tread.column().annulus;
  const Matrix deviation = deviation_from_mean(problem, solution, mean);
  const double epsilon = tread.rows() * problem.model().grid.cell_size()[0];
  const double scale = length_ / (problem.model().material.youngs_modulus * epsilon);
  CriterionTerm term{std::vector<double>(solution.positions.size()),
                     {0, 0, Matrix(deviation.rows(), deviation.columns())}};
  for (int j = 0; j < deviation.columns(); ++j) {
    double& value = term.values[j / problem.tread().n_columns()];
    for (size_t q = 0; q < points.size(); ++q)
      for (int d = 0; d < dim; ++d) {
        const int row = tread.n_contact() + dim * static_cast<int>(q) + d;
        const double weight = scale * points[q].weight, t = deviation(row, j);
        value += 0.5 * weight * t * t;
        term.loads.observations(row, j) = -weight * t;  // (63)
      }
  }
  return term;
}

template class UniformityAnnulus<2>;
template class UniformityAnnulus<3>;

}  // namespace wheelwright
