#include "wheelwright/optimization/optimizer/quadratic_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/linalg/add_scaled.h"
#include "wheelwright/linalg/box_program.h"
#include "wheelwright/optimization/optimizer/curvature_memory.h"

namespace wheelwright {
namespace {

double inner(const Matrix& products, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (int i = 0; i < products.rows(); ++i)
    for (int j = 0; j < products.columns(); ++j) sum += a[i] * products(i, j) * b[j];
  return sum;
}

/// The inner product of a vector of the span and a combination of them.
double product_with(const Matrix& products, int vector, const std::vector<double>& combination) {
  double sum = 0;
  for (int j = 0; j < products.columns(); ++j) sum += products(vector, j) * combination[j];
  return sum;
}

double violation(const LinearConstraint& c, double left) {
  return c.is_equality ? std::abs(left) : std::max(left, 0.0);
}

}  // namespace

// With the multipliers x, d = -(B + shift)^-1 (g + sum x_i sign_i a_i), and x minimizes the dual program x.A
// (B + shift)^-1 A^T x / 2 + x.(A (B + shift)^-1 g - gap), A the rows sign_i a_i, for 0 <= x <= penalty, or
// -penalty <= x <= penalty for an equality.
QuadraticStep quadratic_step(const QuadraticModel& model, double shift) {
  const int n = model.products.rows(), m = static_cast<int>(model.constraints.size());
  const ShiftedHessian hessian(model.products, model.first_move, model.n_pairs, shift);
  std::vector<double> objective(n, 0.0);
  objective[0] = 1;
  std::vector<std::vector<double>> rows, solved, products;  // of all vectors of the span with the solved ones
  for (const auto& c : model.constraints) {
    rows.emplace_back(n, 0.0)[c.vector] = c.sign;
    solved.push_back(hessian.solve(rows.back()));
    auto& with_all = products.emplace_back();
    for (int i = 0; i < n; ++i) with_all.push_back(product_with(model.products, i, solved.back()));
  }
  auto d = hessian.solve(objective);
  for (double& value : d) value = -value;
  BoxProgram dual{Matrix(m, m), {}, {}, {}};
  for (int i = 0; i < m; ++i) {
    const auto& c = model.constraints[i];
    for (int j = 0; j < m; ++j)
      dual.quadratic(i, j) = 0.5 * (c.sign * products[j][c.vector] +
                                    model.constraints[j].sign * products[i][model.constraints[j].vector]);
    dual.linear.push_back(-(c.sign * product_with(model.products, c.vector, d) + c.gap + c.bend));
    dual.lower.push_back(c.is_equality ? -c.penalty : 0);
    dual.upper.push_back(c.penalty);
  }
  const auto [multipliers, is_bounded] = solve(dual);
  std::vector<double> force = objective;  // the gradient of the Lagrangian: (B + shift) d = -force
  for (int i = 0; i < m; ++i) {
    add_scaled(-multipliers[i], solved[i], d);
    add_scaled(multipliers[i], rows[i], force);
  }
  QuadraticStep step{.coefficients = d,
                     .multipliers = multipliers,
                     .shift = shift,
                     .slope = inner(model.products, objective, d),
                     .decrease = 0,
                     .gaps = {},
                     .violations = {},
                     .is_feasible = is_bounded};
  const double curvature =
      -inner(model.products, d, force) - shift * inner(model.products, d, d);  // (d, B d)
  step.decrease = -step.slope - curvature / 2;
  for (int i = 0; i < m; ++i) {
    const auto& c = model.constraints[i];
    step.gaps.push_back(c.gap + c.bend + c.sign * product_with(model.products, c.vector, d));
    const double after = violation(c, step.gaps.back());
    if (c.is_in_merit && !std::isinf(c.penalty)) step.decrease += c.penalty * (violation(c, c.gap) - after);
    step.violations.push_back(after);
  }
  return step;
}

QuadraticStep trust_region_step(const QuadraticModel& model, double radius,
                                const std::function<double(const std::vector<double>&)>& length) {
  constexpr double near = 0.97, farthest_shift = 1e12;
  constexpr int max_searches = 60;
  std::vector<double> gradient(model.products.rows(), 0.0);
  gradient[0] = 1;
  const double natural = std::max(length(gradient) / radius,
                                  ShiftedHessian::scale(model.products, model.first_move, model.n_pairs));
  if (!(natural > 0)) return quadratic_step(model, 1);
  if (model.n_pairs > 0) {
    auto whole = quadratic_step(model, 0);
    if (length(whole.coefficients) <= radius) return whole;
  }
  // 1 / length is nearly linear in the shift. The search is for its root between a shift that is too small
  // and one that is large enough, by secants, or by geometric means where these leave the interval.
  struct Point {
    double shift, inverse;  ///< of the length, less that of the radius
  };
  std::optional<Point> too_small, enough;
  std::optional<QuadraticStep> best;
  double shift = natural;
  for (int k = 0; k < max_searches; ++k) {
    auto step = quadratic_step(model, shift);
    const double reached = length(step.coefficients);
    const Point point{shift, 1 / reached - 1 / (std::sqrt(near) * radius)};
    if (reached <= radius) {
      best = step;
      enough = point;
      if (reached >= near * radius || shift < natural / farthest_shift) break;
    } else {
      if (!best && shift >= farthest_shift * natural) return step;
      too_small = point;
    }
    if (!too_small) {
      shift = enough->shift / 16;
    } else if (!enough) {
      shift = 16 * too_small->shift;
    } else {
      if (enough->shift < (1 + 1e-9) * too_small->shift) break;
      shift = too_small->shift - too_small->inverse * (enough->shift - too_small->shift) /
                                     (enough->inverse - too_small->inverse);
      const double margin = 0.02 * (enough->shift - too_small->shift);
      if (k % 3 == 2 || !(shift > too_small->shift + margin && shift < enough->shift - margin))
        shift = std::sqrt(too_small->shift * enough->shift);
    }
  }
  return *best;
}

}  // namespace wheelwright
