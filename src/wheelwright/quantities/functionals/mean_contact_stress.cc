#include "wheelwright/quantities/functionals/mean_contact_stress.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "wheelwright/base/periodic.h"
#include "wheelwright/quantities/functionals/column_shift.h"

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
    const int n_vectors = dim * tread.rows().n_vectors();
    std::copy(from + n_vectors, from + image.rows(), to + n_vectors);
  }
  return image;
}

/// A turn by any angle of what is observed all round: by whole columns, then by a part of one.
template <int dim>
class Turn {
 public:
  /// Turns what the body observes into the ground's frame, or back.
  static Turn to_ground(const TreadSurface<dim>& tread, const GroundPosition& ground) {
    return {tread, ground.column, ground.offset};
  }
  static Turn to_body(const TreadSurface<dim>& tread, const GroundPosition& ground) {
    if (ground.offset == 0) return {tread, -ground.column, 0};
    return {tread, -ground.column - 1, 1 - ground.offset};
  }

  /// Adds `factor` times the turned observations; both begin at the ring's first column.
  void add(double factor, const double* from, Matrix& to, int first = 0) const {
    for (int g = 0; g < n_columns_; ++g)
      shift_.add(factor, from + column(g), from + column(g + 1), to.column(first + g));
  }

  /// The transpose, from loads on the turned observations.
  void add_transposed(double factor, const Matrix& from, int first, double* to) const {
    for (int g = 0; g < n_columns_; ++g)
      shift_.add_transposed(factor, from.column(first + g), to + column(g), to + column(g + 1));
  }

 private:
  Turn(const TreadSurface<dim>& tread, int columns, double fraction)
      : shift_(tread, fraction),
        columns_(columns),
        n_columns_(tread.n_columns),
        n_rows_(tread.rows().size()) {}

  /// Where the numbers of the column begin that lies at turned column g.
  std::size_t column(int g) const { return std::size_t(n_rows_) * wrap(g + columns_, n_columns_); }

  ColumnShift<dim> shift_;
  int columns_, n_columns_, n_rows_;
};

/// The same for a wheel whose positions stand for their mirror images too. Its own transpose.
template <int dim>
Matrix averaged_with_image(const TreadSurface<dim>& tread, const LoadPositions& positions, Matrix mean) {
  if (!positions.stand_for_images()) return mean;
  mean = sum(mirrored(tread, mean), mean);
  for (double& x : mean.entries()) x /= 2;
  return mean;
}

double count(const LoadPositions& positions) {
  return std::accumulate(positions.multiplicities.begin(), positions.multiplicities.end(), 0.0);
}

}  // namespace

template <int dim>
Matrix mean_observations(const TreadSurface<dim>& tread, const State<dim>& state) {
  return mean_over_positions(tread, state.positions(), state.observations());
}

template <int dim>
Matrix mean_over_positions(const TreadSurface<dim>& tread, const LoadPositions& positions,
                           const Matrix& observations) {
  Matrix mean(observations.rows(), tread.n_columns);
  for (int i = 0; i < positions.size(); ++i)
    Turn<dim>::to_ground(tread, positions.grounds[i])
        .add(positions.multiplicities[i] / count(positions), observations.column(i * tread.n_columns), mean);
  return averaged_with_image(tread, positions, std::move(mean));
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
    Turn<dim>::to_body(tread, positions.grounds[i]).add(-1, mean.data(), observations, i * tread.n_columns);
  return observations;
}

template <int dim>
void add_derivative_of_mean(const TreadSurface<dim>& tread, const LoadPositions& positions, Matrix& loads) {
  Matrix on_mean(loads.rows(), tread.n_columns);
  for (int i = 0; i < positions.size(); ++i)
    Turn<dim>::to_body(tread, positions.grounds[i])
        .add_transposed(positions.multiplicities[i] / count(positions), loads, i * tread.n_columns,
                        on_mean.data());
  on_mean = averaged_with_image(tread, positions, std::move(on_mean));
  for (int i = 0; i < positions.size(); ++i)
    Turn<dim>::to_ground(tread, positions.grounds[i])
        .add_transposed(-1, on_mean, 0, loads.column(i * tread.n_columns));
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                  \
  template Matrix mean_observations(const TreadSurface<dim>&, const State<dim>&);                     \
  template Matrix mean_over_positions(const TreadSurface<dim>&, const LoadPositions&, const Matrix&); \
  template bool is_mirror_symmetric(const TreadSurface<dim>&, const Matrix&);                         \
  template void add_derivative_of_mean(const TreadSurface<dim>&, const LoadPositions&, Matrix&);      \
  template Matrix deviation_from_mean(const TreadSurface<dim>&, const LoadPositions&, Matrix, const Matrix&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
