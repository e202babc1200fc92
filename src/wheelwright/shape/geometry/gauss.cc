#include "wheelwright/shape/geometry/gauss.h"

#include <cmath>
#include <numbers>

namespace wheelwright {

GaussRule gauss_rule(int n) {
  GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int i = 0; i < n; ++i) {
    // Newton's method for a root of the Legendre polynomial P_n, started at the asymptotic root.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      derivative = n * (x * p - previous) / (x * x - 1);
      const double step = p / derivative;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.points[n - 1 - i] = 0.5 * (1 + x);
    rule.weights[n - 1 - i] = 1 / ((1 - x * x) * derivative * derivative);
  }
  return rule;
}

template <int dim>
std::vector<ReferencePoint<dim>> unit_cell_rule(int n) {
  const GaussRule rule = gauss_rule(n);
  std::vector<ReferencePoint<dim>> points(power(n, dim));
  for (int q = 0; q < static_cast<int>(points.size()); ++q) {
    points[q].weight = 1;
    for (int d = 0, rest = q; d < dim; ++d, rest /= n) {
      points[q].xi[d] = rule.points[rest % n];
      points[q].weight *= rule.weights[rest % n];
    }
  }
  return points;
}

template decltype(unit_cell_rule<1>) unit_cell_rule<1>;
template decltype(unit_cell_rule<2>) unit_cell_rule<2>;
template decltype(unit_cell_rule<3>) unit_cell_rule<3>;

}  // namespace wheelwright
