#include "wheelwright/quantities/functionals/column_shift.h"

#include <cmath>
#include <numbers>

#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

/// The value at x of the Lagrange polynomial that is 1 at node k and 0 at the others.
double lagrange(const std::vector<double>& nodes, int k, double x) {
  double value = 1;
  for (int m = 0; m < static_cast<int>(nodes.size()); ++m)
    if (m != k) value *= (x - nodes[m]) / (nodes[k] - nodes[m]);
  return value;
}

/// A place on a row of faces: on a face, and where on it.
struct Place {
  int face;
  double at;  ///< in [0, 1]
  double weight;
};

/// The one or two faces at x, counted in faces.
std::vector<Place> places(double x) {
  constexpr double rounding = 1e-9;
  const double nearest = std::round(x);
  const int face = static_cast<int>(nearest);
  if (std::abs(x - nearest) < rounding) return {{face - 1, 1, 0.5}, {face, 0, 0.5}};
  const double first = std::floor(x);
  return {{static_cast<int>(first), x - first, 1}};
}

std::array<double, 2> turn(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

template <int dim>
ColumnShift<dim>::ColumnShift(const TreadSurface<dim>& tread, double fraction) : fraction_(fraction) {
  if (tread.has_spin) number_ = tread.rows().spin();
  const double width = 2 * std::numbers::pi / tread.n_columns;
  to_shifted_frame_ = {turn(-fraction * width), turn((1 - fraction) * width)};
  if (fraction == 0) {
    for (int k = 0; k < tread.rows().n_vectors(); ++k) shares_.push_back({k, k, false, 1});
    return;
  }
  for (const FaceRow& row : tread.face_rows) interpolate(row, fraction);
  const int integral = tread.rows().integral() / dim;
  shares_.push_back({integral, integral, false, 1 - fraction});
  shares_.push_back({integral, integral, true, fraction});
}

template <int dim>
void ColumnShift<dim>::interpolate(const FaceRow& row, double fraction) {
  const auto nodes = gauss_rule(row.points_per_face).points;
  for (int face = 0; face < row.faces; ++face)
    for (int a = 0; a < row.points_per_face; ++a)
      for (const Place& place : places(face + nodes[a] + fraction * row.faces))
        for (int b = 0; b < row.points_per_face; ++b)
          shares_.push_back({row.observation(face, a), row.observation(place.face % row.faces, b),
                             place.face >= row.faces, place.weight * lagrange(nodes, b, place.at)});
}

template <int dim>
void ColumnShift<dim>::add(double factor, const double* column, const double* next, double* shifted) const {
  for (const auto& [to, from, from_next, weight] : shares_) {
    const double* x = (from_next ? next : column) + dim * from;
    double* y = shifted + dim * to;
    const auto [cosine, sine] = to_shifted_frame_[from_next];
    const double share = factor * weight;
    y[0] += share * (cosine * x[0] - sine * x[1]);
    y[1] += share * (sine * x[0] + cosine * x[1]);
    for (int d = 2; d < dim; ++d) y[d] += share * x[d];
  }
  if (number_)
    shifted[*number_] += factor * ((1 - fraction_) * column[*number_] + fraction_ * next[*number_]);
}

template <int dim>
void ColumnShift<dim>::add_transposed(double factor, const double* shifted, double* column,
                                      double* next) const {
  for (const auto& [to, from, from_next, weight] : shares_) {
    const double* y = shifted + dim * to;
    double* x = (from_next ? next : column) + dim * from;
    const auto [cosine, sine] = to_shifted_frame_[from_next];
    const double share = factor * weight;
    x[0] += share * (cosine * y[0] + sine * y[1]);
    x[1] += share * (cosine * y[1] - sine * y[0]);
    for (int d = 2; d < dim; ++d) x[d] += share * y[d];
  }
  if (!number_) return;
  column[*number_] += factor * (1 - fraction_) * shifted[*number_];
  next[*number_] += factor * fraction_ * shifted[*number_];
}

template class ColumnShift<2>;
template class ColumnShift<3>;

}  // namespace wheelwright
