#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace wheelwright {

/// A point or vector in R^dim. In polar coordinates of the ring, axis 0 is radial, axis 1 azimuthal and axis
/// 2 axial.
template <int dim>
using Vec = std::array<double, dim>;

/// A dim x dim tensor in row-major order: m[i][j].
template <int dim>
using Mat = std::array<std::array<double, dim>, dim>;

template <std::size_t dim>
constexpr std::array<double, dim>& operator+=(std::array<double, dim>& a, const std::array<double, dim>& b) {
  for (std::size_t d = 0; d < dim; ++d) a[d] += b[d];
  return a;
}

template <std::size_t dim>
constexpr std::array<double, dim>& operator-=(std::array<double, dim>& a, const std::array<double, dim>& b) {
  for (std::size_t d = 0; d < dim; ++d) a[d] -= b[d];
  return a;
}

template <std::size_t dim>
constexpr std::array<double, dim> operator+(std::array<double, dim> a, const std::array<double, dim>& b) {
  return a += b;
}

template <std::size_t dim>
constexpr std::array<double, dim> operator-(std::array<double, dim> a, const std::array<double, dim>& b) {
  return a -= b;
}

template <std::size_t dim>
constexpr std::array<double, dim> operator*(double factor, std::array<double, dim> a) {
  for (double& component : a) component *= factor;
  return a;
}

template <std::size_t dim>
constexpr std::array<double, dim> operator/(std::array<double, dim> a, double divisor) {
  for (double& component : a) component /= divisor;
  return a;
}

template <std::size_t dim>
constexpr double dot(const std::array<double, dim>& a, const std::array<double, dim>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < dim; ++d) sum += a[d] * b[d];
  return sum;
}

template <std::size_t dim>
double norm(const std::array<double, dim>& a) {
  return std::sqrt(dot(a, a));
}

template <class Number, std::size_t dim>
constexpr std::array<double, dim> componentwise_product(const std::array<Number, dim>& a,
                                                        std::array<double, dim> b) {
  for (std::size_t d = 0; d < dim; ++d) b[d] *= a[d];
  return b;
}

/// The point at t of the way from a to b.
template <std::size_t dim>
constexpr std::array<double, dim> between(const std::array<double, dim>& a, const std::array<double, dim>& b,
                                          double t) {
  return a + t * (b - a);
}

inline double distance(const Vec<2>& a, const Vec<2>& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The distance of x from the segment between a and b.
inline double distance_to_segment(const Vec<2>& x, const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> along = b - a, from = x - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(from, along) / square, 0.0, 1.0) : 0;
  return distance(from, t * along);
}

/// The third component of the cross product: positive if b is to the left of a.
constexpr double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

constexpr Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a turned to the left by a right angle.
constexpr Vec<2> left_of(const Vec<2>& a) { return {-a[1], a[0]}; }

/// Returns the determinant of m.
template <int dim>
constexpr double determinant(const Mat<dim>& m) {
  if constexpr (dim == 1) {
    return m[0][0];
  } else if constexpr (dim == 2) {
    return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  } else {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
}

/// Returns the inverse of m, which must not be singular.
template <int dim>
constexpr Mat<dim> inverse(const Mat<dim>& m) {
  const double scale = 1 / determinant<dim>(m);
  if constexpr (dim == 2) {
    return {{{m[1][1] * scale, -m[0][1] * scale}, {-m[1][0] * scale, m[0][0] * scale}}};
  } else {
    Mat<dim> result{};
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        const int i1 = (i + 1) % dim, i2 = (i + 2) % dim, j1 = (j + 1) % dim, j2 = (j + 2) % dim;
        result[j][i] = (m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]) * scale;
      }
    }
    return result;
  }
}

/// Returns m^T v.
template <int dim>
constexpr Vec<dim> transpose_times(const Mat<dim>& m, const Vec<dim>& v) {
  Vec<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) result[j] += m[i][j] * v[i];
  return result;
}

/// Returns n^dim for small integers.
constexpr int power(int n, int dim) {
  int result = 1;
  for (int d = 0; d < dim; ++d) result *= n;
  return result;
}

}  // namespace wheelwright
