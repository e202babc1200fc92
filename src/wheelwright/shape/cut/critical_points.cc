#include "wheelwright/shape/cut/critical_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/base/vec.h"

namespace wheelwright {
namespace {

/// Bernstein coefficients of degree 2 in each of three coordinates, the first the fastest.
using Coefficients = std::array<double, 27>;
using System = std::array<Coefficients, 3>;

constexpr int max_boxes = 4000, max_depth = 16, max_newton_steps = 30;

template <class Visit>
void for_each_line(int axis, Visit visit) {
  const int stride = power(3, axis);
  for (int line = 0; line < 9; ++line) visit(line % stride + line / stride * 3 * stride, stride);
}

/// The derivative along an axis, written with degree 2 along it too.
Coefficients derivative(const Coefficients& f, int axis) {
  Coefficients result;
  for_each_line(axis, [&](int a, int stride) {
    const double first = 2 * (f[a + stride] - f[a]), last = 2 * (f[a + 2 * stride] - f[a + stride]);
    result[a] = first;
    result[a + stride] = 0.5 * (first + last);
    result[a + 2 * stride] = last;
  });
  return result;
}

double value(const Coefficients& f, const Vec<3>& x) {
  std::array<std::array<double, 3>, 3> basis;
  for (int d = 0; d < 3; ++d) basis[d] = {(1 - x[d]) * (1 - x[d]), 2 * x[d] * (1 - x[d]), x[d] * x[d]};
  double sum = 0;
  for (int a = 0; a < 27; ++a) sum += f[a] * basis[0][a % 3] * basis[1][a / 3 % 3] * basis[2][a / 9];
  return sum;
}

/// One of the eight halves of the box.
Coefficients half(Coefficients f, int corner) {
  for (int d = 0; d < 3; ++d)
    for_each_line(d, [&](int a, int stride) {
      double &c0 = f[a], &c1 = f[a + stride], &c2 = f[a + 2 * stride];
      const double left = 0.5 * (c0 + c1), right = 0.5 * (c1 + c2), middle = 0.5 * (left + right);
      if ((corner >> d) % 2 == 0) {
        c1 = left;
        c2 = middle;
      } else {
        c0 = middle;
        c1 = right;
      }
    });
  return f;
}

bool changes_sign(const Coefficients& f) {
  const auto [low, high] = std::minmax_element(f.begin(), f.end());
  return *low <= 0 && *high >= 0;
}

Mat<3> jacobian(const System& f, const Vec<3>& x) {
  Mat<3> result;
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 3; ++d) result[i][d] = value(derivative(f[i], d), x);
  return result;
}

/// The system multiplied by the inverse of its Jacobian in the middle of the box.
std::optional<System> preconditioned(const System& f) {
  const Mat<3> at_middle = jacobian(f, {0.5, 0.5, 0.5});
  double scale = 1;
  for (const auto& row : at_middle) scale *= norm<3>(row);
  if (!(std::abs(determinant<3>(at_middle)) > 1e-8 * scale)) return {};
  const Mat<3> to_unit = inverse<3>(at_middle);
  System result{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a < 27; ++a) result[i][a] += to_unit[i][k] * f[k][a];
  return result;
}

/// Whether the preconditioned system is so nearly linear that it has at most one zero in the box, found by
/// Newton's method.
bool is_nearly_linear(const System& g) {
  for (int i = 0; i < 3; ++i) {
    double deviation = 0;
    for (int d = 0; d < 3; ++d) {
      double largest = 0;
      for (const double slope : derivative(g[i], d)) largest = std::max(largest, std::abs(slope - (i == d)));
      deviation += largest;
    }
    if (deviation > 0.7) return false;
  }
  return true;
}

std::optional<Vec<3>> newton(const System& g) {
  Vec<3> x{0.5, 0.5, 0.5};
  for (int step = 0; step < max_newton_steps; ++step) {
    const Mat<3> j = jacobian(g, x);
    if (!(std::abs(determinant<3>(j)) > 1e-3)) return {};
    const Mat<3> to_step = inverse<3>(j);
    double change = 0;
    Vec<3> next = x;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) next[i] -= to_step[i][k] * value(g[k], x);
    for (int i = 0; i < 3; ++i) change = std::max(change, std::abs(next[i] - x[i]));
    x = next;
    for (const double c : x)
      if (!(std::abs(c - 0.5) < 1)) return {};
    if (change < 1e-14) break;
  }
  for (const double c : x)
    if (!(c > -1e-6 && c < 1 + 1e-6)) return {};
  return x;
}

struct Box {
  System f;
  double from, width;  ///< along the third coordinate
  int depth;
};

}  // namespace

std::vector<double> critical_places(const BernsteinForm<3>& psi, const std::array<int, 3>& axes) {
  Coefficients f;
  for (int a = 0; a < 27; ++a) {
    std::array<int, 3> index;
    index[axes[0]] = a % 3;
    index[axes[1]] = a / 3 % 3;
    index[axes[2]] = a / 9;
    f[a] = psi[index];
  }
  std::vector<double> places;
  std::vector<Box> boxes{{{f, derivative(f, 0), derivative(f, 1)}, 0, 1, 0}};
  for (size_t next = 0; next < boxes.size() && next < max_boxes; ++next) {
    const Box box = boxes[next];
    if (!std::all_of(box.f.begin(), box.f.end(), changes_sign)) continue;
    if (const auto g = preconditioned(box.f)) {
      if (!std::all_of(g->begin(), g->end(), changes_sign)) continue;
      if (is_nearly_linear(*g)) {
        if (const auto x = newton(*g)) places.push_back(box.from + box.width * (*x)[2]);
        continue;
      }
    }
    if (box.depth == max_depth) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const int layer = corner / 4;
      Box part{box.f, box.from + layer * 0.5 * box.width, 0.5 * box.width, box.depth + 1};
      for (Coefficients& component : part.f) component = half(component, corner);
      boxes.push_back(part);
    }
  }
  std::erase_if(places, [](double x) { return !(x > 0 && x < 1); });
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace wheelwright
