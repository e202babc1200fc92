#include "wheelwright/functionals/mean_contact_stress.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace wheelwright {

namespace {

/// The mirror image of what is observed all round at one load position, both counted as the mean.
template <int dim>
Matrix mirrored(const Tread<dim>& tread, const Matrix& observations) {
  const TreadColumn<dim>& column = tread.column();
  // A column's image is seen in the frame of the one before its own: the reflection, turned by a column.
  const double column_angle = 2 * std::numbers::pi / tread.n_columns();
  const double cosine = std::cos(column_angle), sine = std::sin(column_angle);
  auto image = Matrix::unfilled(observations.rows(), observations.columns());
  for (int g = 0; g < image.columns(); ++g) {
    const double* from = observations.column(image.columns() - 1 - g);
    double* to = image.column(g);
    for (size_t k = 0; k < column.mirror_images.size(); ++k) {
      const double* v = from + dim * column.mirror_images[k];
      double* reflected = to + dim * k;
      reflected[0] = cosine * v[0] + sine * v[1];
      reflected[1] = sine * v[0] - cosine * v[1];
      std::copy(v + 2, v + dim, reflected + 2);
    }
  }
  return image;
}

}  // namespace

template <int dim>
Matrix mean_observations(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution) {
  const int n_columns = problem.tread().n_columns();
  const LoadPositions& positions = solution.positions;
  const double n_all = std::accumulate(positions.multiplicities.begin(), positions.multiplicities.end(), 0.0);
  Matrix mean(solution.observations.rows(), n_columns);
  for (int i = 0; i < positions.size(); ++i) {
    const double weight = positions.multiplicities[i] / n_all;
    for (int g = 0; g < n_columns; ++g) {
      const double* x =
          solution.observations.column(i * n_columns + (g + positions.grounds[i].column) % n_columns);
      for (int row = 0; row < mean.rows(); ++row) mean(row, g) += weight * x[row];
    }
  }
  if (!positions.stand_for_images()) return mean;
  mean = sum(mirrored(problem.tread(), mean), mean);
  for (double& x : mean.entries()) x /= 2;
  return mean;
}

template <int dim>
bool is_mirror_symmetric(const Tread<dim>& tread, const Matrix& mean) {
  const Matrix image = mirrored(tread, mean);
  const double tolerance = 1e-8 * largest_entry(mean);
  return std::equal(mean.entries().begin(), mean.entries().end(), image.entries().begin(),
                    [&](double a, double b) { return std::abs(a - b) <= tolerance; });
}

template <int dim>
Matrix deviation_from_mean(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                           const Matrix& mean) {
  const int n_columns = problem.tread().n_columns();
  Matrix deviation = solution.observations;
  for (int i = 0; i < solution.positions.size(); ++i)
    for (int g = 0; g < n_columns; ++g) {
      double* x = deviation.column(i * n_columns + (g + solution.positions.grounds[i].column) % n_columns);
      for (int row = 0; row < mean.rows(); ++row) x[row] -= mean(row, g);
    }
  return deviation;
}

template Matrix mean_observations(const RollingProblem<2>&, const RollingSolution<2>&);
template Matrix mean_observations(const RollingProblem<3>&, const RollingSolution<3>&);
template bool is_mirror_symmetric(const Tread<2>&, const Matrix&);
template bool is_mirror_symmetric(const Tread<3>&, const Matrix&);
template Matrix deviation_from_mean(const RollingProblem<2>&, const RollingSolution<2>&, const Matrix&);
template Matrix deviation_from_mean(const RollingProblem<3>&, const RollingSolution<3>&, const Matrix&);

}  // namespace wheelwright
