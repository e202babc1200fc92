#include "criteria/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
Matrix mean_observations(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution) {
  const int n_columns = problem.tread().n_columns(), n_positions = static_cast<int>(solution.grounds.size());
  Matrix mean(solution.observations.rows(), n_columns);
  for (int i = 0; i < n_positions; ++i)
    for (int g = 0; g < n_columns; ++g) {
      const double* x =
          solution.observations.column(i * n_columns + (g + solution.grounds[i].column) % n_columns);
      for (int row = 0; row < mean.rows(); ++row) mean(row, g) += x[row] / n_positions;
    }
  return mean;
}

template <int dim>
Matrix deviation_from_mean(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                           const Matrix& mean) {
  const int n_columns = problem.tread().n_columns();
  Matrix deviation = solution.observations;
  for (int i = 0; i < static_cast<int>(solution.grounds.size()); ++i)
    for (int g = 0; g < n_columns; ++g) {
      double* x = deviation.column(i * n_columns + (g + solution.grounds[i].column) % n_columns);
      for (int row = 0; row < mean.rows(); ++row) x[row] -= mean(row, g);
    }
  return deviation;
}

template Matrix mean_observations(const RollingProblem<2>&, const RollingSolution<2>&);
template Matrix mean_observations(const RollingProblem<3>&, const RollingSolution<3>&);
template Matrix deviation_from_mean(const RollingProblem<2>&, const RollingSolution<2>&, const Matrix&);
template Matrix deviation_from_mean(const RollingProblem<3>&, const RollingSolution<3>&, const Matrix&);

}  // namespace wheelwright
