#include "wheelwright/shape/cut/bernstein.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

Quartic product(const Quadratic& a, const Quadratic& b) {
  return {a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]), ((a[0] * b[2] + a[2] * b[0]) + 4 * a[1] * b[1]) / 6,
          0.5 * (a[1] * b[2] + a[2] * b[1]), a[2] * b[2]};
}

using Complex = std::complex<double>;

/// A polynomial in powers of y, the constant first.
using Powers = std::array<double, 5>;

/// Durand and Kerner's simultaneous iteration.
std::vector<Complex> rough_zeros(const Powers& p, int degree) {
  std::vector<Complex> zeros;
  for (int i = 0; i < degree; ++i) zeros.push_back(std::pow(Complex(0.4, 0.9), i));
  for (int iteration = 0; iteration < 80; ++iteration) {
    double change = 0;
    for (int i = 0; i < degree; ++i) {
      Complex value = p[degree], others = p[degree];
      for (int k = degree - 1; k >= 0; --k) value = value * zeros[i] + p[k];
      for (int j = 0; j < degree; ++j)
        if (j != i) others *= zeros[i] - zeros[j];
      const Complex step = value / others;
      if (!std::isfinite(std::abs(step))) continue;
      zeros[i] -= step;
      change = std::max(change, std::abs(step) / (1e-3 + std::abs(zeros[i])));
    }
    if (change < 1e-9) break;
  }
  return zeros;
}

/// Quotient of a polynomial and y^2 - r y - s, from place 2 on, and its remainder before.
Powers divided(const Powers& p, double r, double s) {
  Powers b = p;
  b[3] += r * b[4];
  for (int k = 2; k >= 0; --k) b[k] += r * b[k + 1] + s * b[k + 2];
  return b;
}

/// The indices of two zeros of a quartic that are the zeros of a real quadratic, as the other two then are:
/// conjugates, or real and close to each other. Of two such pairs, the one closer to 0.
std::array<int, 2> real_pair(const std::vector<Complex>& zeros) {
  const auto distance = [&](int i, int j) {  // on the sphere, where infinity is a point
    return std::abs(zeros[i] - std::conj(zeros[j])) / ((1 + std::abs(zeros[i])) * (1 + std::abs(zeros[j])));
  };
  const auto total = [&](const auto& p) { return distance(p[0], p[1]) * distance(p[2], p[3]); };
  std::array<int, 4> best{0, 1, 2, 3};
  for (const std::array<int, 4>& other : {std::array{0, 2, 1, 3}, std::array{0, 3, 1, 2}})
    if (total(other) < total(best)) best = other;
  const auto size = [&](int i, int j) { return std::abs(zeros[i]) + std::abs(zeros[j]); };
  if (size(best[2], best[3]) < size(best[0], best[1])) return {best[2], best[3]};
  return {best[0], best[1]};
}

/// The zeros of a polynomial of degree 3 or 4. Two of them are refined as the zeros of a real quadratic
/// factor (Bairstow's method), which is accurate to rounding even if the zeros are not.
std::vector<Complex> paired_zeros(const Powers& p, int degree) {
  auto rough = rough_zeros(p, degree);
  if (degree == 3) rough.push_back(1e100);
  const auto pair = real_pair(rough);
  double r = (rough[pair[0]] + rough[pair[1]]).real(), s = -(rough[pair[0]] * rough[pair[1]]).real();
  for (int iteration = 0; iteration < 6; ++iteration) {
    const Powers b = divided(p, r, s), c = divided(b, r, s);
    const double determinant = c[2] * c[2] - c[3] * c[1];
    const double dr = (c[3] * b[0] - c[2] * b[1]) / determinant,
                 ds = (c[1] * b[1] - c[2] * b[0]) / determinant;
    if (!std::isfinite(dr + ds)) break;
    r += dr;
    s += ds;
  }
  const auto [first, second] = zeros_of(r, s);
  const Powers b = divided(p, r, s);
  if (degree == 3) return {first, second, -b[2] / b[3]};
  const auto [third, fourth] = zeros_of(-b[3] / b[4], -b[2] / b[4]);
  return {first, second, third, fourth};
}

}  // namespace

std::array<std::complex<double>, 2> zeros_of(double r, double s) {
  const double squared = std::fma(0.5 * r, 0.5 * r, s);
  if (squared < 0)
    return {std::complex<double>(0.5 * r, std::sqrt(-squared)),
            std::complex<double>(0.5 * r, -std::sqrt(-squared))};
  const double larger = 0.5 * r + std::copysign(std::sqrt(squared), r);
  return {larger, larger == 0 ? 0 : -s / larger};
}

Root root(const Quadratic& c, double half_slope, bool rising) {
  if (rising) return c[1] <= 0 ? Root{half_slope - c[1], c[2]} : Root{-c[0], half_slope + c[1]};
  return c[1] >= 0 ? Root{-(half_slope + c[1]), c[2]} : Root{c[0], half_slope - c[1]};
}

Quartic discriminant_of(const std::array<Quadratic, 3>& c) {
  const Quartic square = product(c[1], c[1]), ends = product(c[0], c[2]);
  Quartic result;
  for (int i = 0; i < 5; ++i) result[i] = square[i] - ends[i];
  return result;
}

std::vector<double> sign_changes(const Quadratic& c) {
  std::vector<double> result;
  if (discriminant(c) < 0) return result;
  const double half_slope = std::sqrt(discriminant(c));
  for (const bool rising : {false, true}) {
    const Root place = root(c, half_slope, rising);
    if (place.inside()) result.push_back(place.x());
  }
  std::sort(result.begin(), result.end());
  return result;
}

Factors factors_of(const Quartic& c) {
  // In powers of y = x - 1/2, which a reflection only changes in sign.
  Powers p{((c[0] + c[4]) + 4 * (c[1] + c[3]) + 6 * c[2]) / 16, ((c[4] - c[0]) + 2 * (c[3] - c[1])) / 2,
           1.5 * ((c[0] + c[4]) - 2 * c[2]), 2 * ((c[4] - c[0]) - 2 * (c[3] - c[1])),
           (c[0] + c[4]) - 4 * (c[1] + c[3]) + 6 * c[2]};
  double largest = 0;
  for (const double x : p) largest = std::max(largest, std::abs(x));
  int degree = 4;
  for (; degree > 0 && std::abs(p[degree]) <= 1e-15 * largest; --degree) p[degree] = 0;
  Factors result{p[degree], {}};
  if (degree == 1) result.zeros = {-p[0] / p[1]};
  if (degree == 2) {
    const auto pair = zeros_of(-p[1] / p[2], -p[0] / p[2]);
    result.zeros = {pair[0], pair[1]};
  }
  if (degree > 2) result.zeros = paired_zeros(p, degree);
  for (auto& zero : result.zeros) zero += 0.5;
  return result;
}

template <int dim>
template <class Visit>
void BernsteinForm<dim>::for_each_line(int axis, Visit visit) {
  const int stride = power(3, axis);
  for (int line = 0; line < power(3, dim - 1); ++line)
    visit(line % stride + line / stride * 3 * stride, stride);
}

template <int dim>
BernsteinForm<dim>::BernsteinForm(int degree, std::span<const double> nodal_values) {
  const auto node = [&](const std::array<int, dim>& p) {  // p in 0..degree
    int a = 0;
    for (int d = dim - 1; d >= 0; --d) a = a * (degree + 1) + p[d];
    return nodal_values[a];
  };
  for (int a = 0; a < power(3, dim); ++a) {
    auto p = local_node_position<dim>(2, a);
    if (degree == 2) {
      coefficients_[a] = node(p);
      continue;
    }
    double sum = 0;  // the mean of the corners around the node
    int corners = 0;
    for (int corner = 0; corner < power(2, dim); ++corner) {
      const auto q = local_node_position<dim>(1, corner);
      bool touches = true;
      for (int d = 0; d < dim; ++d) touches = touches && (p[d] == 1 || p[d] == 2 * q[d]);
      if (!touches) continue;
      sum += node(q);
      ++corners;
    }
    coefficients_[a] = sum / corners;
  }
  if (degree == 1) return;
  for (int d = 0; d < dim; ++d)
    for_each_line(d, [&](int a, int stride) {
      double& middle = coefficients_[a + stride];  // 2 f(1/2) - (f(0) + f(1)) / 2
      middle = 2 * middle - 0.5 * (coefficients_[a] + coefficients_[a + 2 * stride]);
    });
}

template <int dim>
double BernsteinForm<dim>::operator[](const std::array<int, dim>& index) const {
  int a = 0;
  for (int d = dim - 1; d >= 0; --d) a = 3 * a + index[d];
  return coefficients_[a];
}

template <int dim>
double BernsteinForm<dim>::largest() const {
  return *std::max_element(coefficients_.begin(), coefficients_.end());
}

template <int dim>
double BernsteinForm<dim>::smallest() const {
  return *std::min_element(coefficients_.begin(), coefficients_.end());
}

template <int dim>
std::array<double, 2> BernsteinForm<dim>::derivative_bounds(int axis) const {
  std::array<double, 2> bounds{INFINITY, -INFINITY};
  for_each_line(axis, [&](int a, int stride) {
    for (const int b : {a, a + stride}) {
      const double difference = coefficients_[b + stride] - coefficients_[b];
      bounds[0] = std::min(bounds[0], difference);
      bounds[1] = std::max(bounds[1], difference);
    }
  });
  return bounds;
}

template <int dim>
double BernsteinForm<dim>::variation(int axis) const {
  double sum = 0;
  for_each_line(axis, [&](int a, int stride) {
    sum += std::abs(coefficients_[a + stride] - coefficients_[a]) +
           std::abs(coefficients_[a + 2 * stride] - coefficients_[a + stride]);
  });
  return sum;
}

template class BernsteinForm<2>;
template class BernsteinForm<3>;

}  // namespace wheelwright
