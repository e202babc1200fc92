#include "wheelwright/cut/bernstein.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// Of two roots closer than this a place between them is returned: deeper, rounding decides.
constexpr int max_halvings = 26;

int sign_variations(const Quartic& c) {
  int variations = 0;
  double before = 0;
  for (const double x : c) {
    if (x == 0) continue;
    if (before != 0 && (before < 0) != (x < 0)) ++variations;
    before = x;
  }
  return variations;
}

/// De Casteljau's algorithm: the polynomial on [0, x] and on [x, 1].
std::array<Quartic, 2> parts(Quartic c, double x) {
  std::array<Quartic, 2> result;
  for (int level = 0; level < 5; ++level) {
    result[0][level] = c[0];
    result[1][4 - level] = c[4 - level];
    for (int i = 0; i + level < 4; ++i) c[i] = c[i] * (1 - x) + c[i + 1] * x;
  }
  return result;
}

double derivative(const Quartic& c, double x) {
  std::array<double, 4> d;
  for (int i = 0; i < 4; ++i) d[i] = 4 * (c[i + 1] - c[i]);
  for (int level = 1; level < 4; ++level)
    for (int i = 0; i + level < 4; ++i) d[i] = d[i] * (1 - x) + d[i + 1] * x;
  return d[0];
}

/// The only root of a polynomial with different signs at 0 and 1, by Newton's method within a shrinking
/// bracket. An end whose value is next to zero is not taken for the root: another one may lie just beyond it.
double only_root(const Quartic& c) {
  double a = 0, b = 1, x = 0.5;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double at_x = wheelwright::value(c, x, 1 - x);
    if (at_x == 0) return x;
    ((at_x < 0) == (c[4] < 0) ? b : a) = x;
    double next = x - at_x / derivative(c, x);
    if (!(next >= a && next <= b)) next = 0.5 * (a + b);
    if (std::abs(next - x) < 1e-16 || b - a < 1e-16) return next;
    x = next;
  }
  return x;
}

void append_sign_changes(const Quartic& c, double from, double width, int halvings,
                         std::vector<double>& result) {
  const int variations = sign_variations(c);
  if (variations == 0) return;
  if (variations == 1 && c[0] != 0 && c[4] != 0) {
    result.push_back(from + width * only_root(c));
    return;
  }
  if (halvings == max_halvings) {
    result.push_back(from + 0.5 * width);
    return;
  }
  const auto [left, right] = parts(c, 0.5);
  append_sign_changes(left, from, 0.5 * width, halvings + 1, result);
  if (left[4] == 0 && sign_variations(left) == 0) result.push_back(from + 0.5 * width);
  append_sign_changes(right, from + 0.5 * width, 0.5 * width, halvings + 1, result);
}

Quartic product(const Quadratic& a, const Quadratic& b) {
  return {a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]), ((a[0] * b[2] + a[2] * b[0]) + 4 * a[1] * b[1]) / 6,
          0.5 * (a[1] * b[2] + a[2] * b[1]), a[2] * b[2]};
}

}  // namespace

Root root(const Quadratic& c, double half_slope, bool rising) {
  if (rising) return c[1] <= 0 ? Root{half_slope - c[1], c[2]} : Root{-c[0], half_slope + c[1]};
  return c[1] >= 0 ? Root{-(half_slope + c[1]), c[2]} : Root{c[0], half_slope - c[1]};
}

Quartic part_of(const Quartic& c, double from, double to) {
  if (from < 1 - to) return parts(parts(c, to)[0], from / to)[1];
  return parts(parts(c, from)[1], (to - from) / (1 - from))[0];
}

double value(Quartic c, double x, double rest) {
  for (int level = 1; level < 5; ++level)
    for (int i = 0; i + level < 5; ++i) c[i] = c[i] * rest + c[i + 1] * x;
  return c[0];
}

Quartic discriminant_of(const std::array<Quadratic, 3>& c) {
  const Quartic square = product(c[1], c[1]), ends = product(c[0], c[2]);
  Quartic result;
  for (int i = 0; i < 5; ++i) result[i] = square[i] - ends[i];
  return result;
}

std::vector<double> sign_changes(const Quartic& c, double noise) {
  std::vector<double> result;
  const auto [low, high] = std::minmax_element(c.begin(), c.end());
  if (*low >= -noise && *high <= noise) return result;
  append_sign_changes(c, 0, 1, 0, result);
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

std::vector<std::complex<double>> complex_zeros(const Quartic& c) {
  // In powers of y = x - 1/2, which a reflection only changes in sign.
  const std::array<double, 5> p{((c[0] + c[4]) + 4 * (c[1] + c[3]) + 6 * c[2]) / 16,
                                ((c[4] - c[0]) + 2 * (c[3] - c[1])) / 2, 1.5 * ((c[0] + c[4]) - 2 * c[2]),
                                2 * ((c[4] - c[0]) - 2 * (c[3] - c[1])),
                                (c[0] + c[4]) - 4 * (c[1] + c[3]) + 6 * c[2]};
  double largest = 0;
  for (const double x : p) largest = std::max(largest, std::abs(x));
  int degree = 4;
  while (degree > 0 && std::abs(p[degree]) <= 1e-10 * largest) --degree;
  // Durand and Kerner's simultaneous iteration.
  std::vector<std::complex<double>> zeros;
  for (int i = 0; i < degree; ++i) zeros.push_back(std::pow(std::complex(0.4, 0.9), i));
  for (int iteration = 0; iteration < 60; ++iteration) {
    double change = 0;
    for (int i = 0; i < degree; ++i) {
      std::complex<double> value = p[degree], others = p[degree];
      for (int k = degree - 1; k >= 0; --k) value = value * zeros[i] + p[k];
      for (int j = 0; j < degree; ++j)
        if (j != i) others *= zeros[i] - zeros[j];
      const auto step = value / others;
      if (!std::isfinite(std::abs(step))) continue;
      zeros[i] -= step;
      change = std::max(change, std::abs(step));
    }
    if (change < 1e-12) break;
  }
  for (auto& zero : zeros) zero += 0.5;
  return zeros;
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
BernsteinForm<dim> BernsteinForm<dim>::part(const std::array<int, dim>& third) const {
  BernsteinForm result = *this;
  for (int d = 0; d < dim; ++d)
    for_each_line(d, [&](int a, int stride) {
      double &c0 = result.coefficients_[a], &c1 = result.coefficients_[a + stride],
             &c2 = result.coefficients_[a + 2 * stride];
      const Quadratic c{c0, c1, c2};
      // Its blossom, which gives the coefficients on every part.
      const auto blossom = [&](int x, int y) {  // in thirds
        return ((3 - x) * (3 - y) * c[0] + x * y * c[2] + ((3 - x) * y + x * (3 - y)) * c[1]) / 9;
      };
      const int from = third[d], to = from + 1;
      c0 = blossom(from, from);
      c1 = blossom(from, to);
      c2 = blossom(to, to);
    });
  return result;
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
double BernsteinForm<dim>::magnitude() const {
  return std::max(largest(), -smallest());
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
