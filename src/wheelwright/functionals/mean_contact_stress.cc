#include "wheelwright/functionals/mean_contact_stress.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace wheelwright {

namespace {

/// The mirror image of what is observed all round at one load position, both counted as the mean.
template <int dim>
Matrix mirrored(const TreadSurface<dim>& tread, const Matrix& observations) {
  // A column's image is seen in the frame of the one before its own: the reflection, turned by a column.
  const double column_angle = 2 * std::numbers::pi / tread.n_columns;
  const double cosine = std::cos(column_angle), sine = std::sin(column_angle);
  auto image = Matrix::unfilled(observations.rows(), observations.columns());
  for (int g = 0; g < image.columns(); ++g) {
    const double* from = observations.column(image.columns() - 1 - g);
    double* to = image.column(g);
    for (size_t k = 0; k < tread.mirror_images.size(); ++k) {
      const double* v = from + dim * tread.mirror_images[k];
      double* reflected = to + dim * k;
      reflected[0] = cosine * v[0] + sine * v[1];
      reflected[1] = sine * v[0] - cosine * v[1];
      std::copy(v + 2, v + dim, reflected + 2);
    }
  }
  return image;
}

/// The ring column of the body that is `column` columns from the ground position.
int ring_column(const GroundPosition& ground, int column, int n_columns) {
  return (column + ground.column) % n_columns;
}

}  // namespace

template <int dim>
Matrix mean_observations(const TreadSurface<dim>& tread, const State<dim>& state) {
  return mean_over_positions(tread, state.positions(), state.observations());
}

template <int dim>
Matrix mean_over_positions(const TreadSurface<dim>& tread, const LoadPositions& positions,
                           const Matrix& observations) {
  const double n_all = std::accumulate(positions.multiplicities.begin(), positions.multiplicities.end(), 0.0);
  Matrix mean(observations.rows(), tread.n_columns);
  for (int i = 0; i < positions.size(); ++i) {
    const double weight = positions.multiplicities[i] / n_all;
    for (int g = 0; g < tread.n_columns; ++g) {
      const double* x =
          observations.column(i * tread.n_columns + ring_column(positions.grounds[i], g, tread.n_columns));
      for (int row = 0; row < mean.rows(); ++row) mean(row, g) += weight * x[row];
    }
  }
  if (!positions.stand_for_images()) return mean;
  mean = sum(mirrored(tread, mean), mean);
  for (double& x : mean.entries()) x /= 2;
  return mean;
}

template <int dim>
bool is_mirror_symmetric(const TreadSurface<dim>& tread, const Matrix& mean) {
  const Matrix image = mirrored(tread, mean);
  const double tolerance = 1e-8 * largest_entry(mean);
  return std::equal(mean.entries().begin(), mean.entries().end(), image.entries().begin(),
                    [&](double a, double b) { return std::abs(a - b) <= tolerance; });
}

template <int dim>
Matrix deviation_from_mean(const TreadSurface<dim>& tread, const LoadPositions& positions,
                           Matrix observations, const Matrix& mean) {
  for (int i = 0; i < positions.size(); ++i)
    for (int g = 0; g < tread.n_columns; ++g) {
      double* x =
          observations.column(i * tread.n_columns + ring_column(positions.grounds[i], g, tread.n_columns));
      for (int row = 0; row < mean.rows(); ++row) x[row] -= mean(row, g);
    }
  return observations;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                  \
  template Matrix mean_observations(const TreadSurface<dim>&, const State<dim>&);                     \
  template bool is_mirror_symmetric(const TreadSurface<dim>&, const Matrix&);                         \
  template Matrix mean_over_positions(const TreadSurface<dim>&, const LoadPositions&, const Matrix&); \
  template Matrix deviation_from_mean(const TreadSurface<dim>&, const LoadPositions&, Matrix, const Matrix&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
