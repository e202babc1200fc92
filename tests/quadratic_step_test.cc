#include "wheelwright/optimization/optimizer/quadratic_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "wheelwright/linalg/box_program.h"
#include "wheelwright/optimization/optimizer/curvature_memory.h"

using namespace wheelwright;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

class Random {
 public:
  explicit Random(int seed) : engine_(seed) {}
  double normal() { return normal_(engine_); }
  bool one_in(int n) { return engine_() % n == 0; }
  int below(int n) { return static_cast<int>(engine_() % n); }
  Matrix matrix(int rows, int columns) {
    Matrix m(rows, columns);
    for (double& entry : m.entries()) entry = normal();
    return m;
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

/// A program of up to ten unknowns, often degenerate: of low rank, badly scaled, with equal or zero rows,
/// with a minimum on bounds. Its minimum is finite: the linear part lies in the range of Q, or all bounds are
/// finite.
BoxProgram random_program(Random& random) {
  const int n = 1 + random.below(10), rank = random.below(n + 1);
  const Matrix factor = random.matrix(rank, n);
  BoxProgram program{product(factor, Op::transpose, factor, Op::none), {}, {}, {}};
  const bool has_open_bounds = random.one_in(2);
  std::vector<double> point(n);
  for (double& x : point) x = random.one_in(4) ? 0 : random.normal();
  for (int i = 0; i < n; ++i) {
    double r = 0;
    for (int j = 0; j < n; ++j) r -= program.quadratic(i, j) * point[j];
    program.linear.push_back(has_open_bounds ? r : random.normal());
    const double low = random.one_in(3) ? 0 : -std::abs(random.normal()), size = std::abs(random.normal());
    program.lower.push_back(has_open_bounds && random.one_in(2) ? -infinite : low);
    program.upper.push_back(has_open_bounds && random.one_in(2) ? infinite
                            : random.one_in(8)                  ? low
                                                                : low + size);
    if (program.lower[i] > program.upper[i]) program.lower[i] = program.upper[i];
  }
  if (n > 1 && random.one_in(4)) {  // the same unknown twice
    for (int j = 0; j < n; ++j) program.quadratic(n - 1, j) = program.quadratic(0, j);
    for (int j = 0; j < n; ++j) program.quadratic(j, n - 1) = program.quadratic(j, 0);
    program.quadratic(n - 1, n - 1) = program.quadratic(0, 0);
    program.linear[n - 1] = program.linear[0];
  }
  for (int i = 0; i < n; ++i) {  // units that differ by orders of magnitude
    const double unit = std::pow(10.0, random.below(9) - 4);
    for (int j = 0; j < n; ++j) {
      program.quadratic(i, j) *= unit;
      program.quadratic(j, i) *= unit;
    }
    program.linear[i] *= unit;
    program.lower[i] /= unit;
    program.upper[i] /= unit;
  }
  return program;
}

TEST(BoxProgram, MeetsTheOptimalityConditionsOfRandomPrograms) {
  Random random(1);
  for (int k = 0; k < 20000; ++k) {
    const BoxProgram program = random_program(random);
    const auto [x, is_bounded] = solve(program);
    ASSERT_TRUE(is_bounded) << k;
    for (size_t i = 0; i < x.size(); ++i) {
      ASSERT_GE(x[i], program.lower[i]) << k;
      ASSERT_LE(x[i], program.upper[i]) << k;
    }
    ASSERT_LT(residual(program, x), 1e-6) << k;
  }
}

TEST(BoxProgram, ReportsAMissingMinimum) {
  Random random(2);
  for (int k = 0; k < 1000; ++k) {
    const int n = 2 + random.below(9);
    const Matrix factor = random.matrix(n - 1, n);
    BoxProgram program{product(factor, Op::transpose, factor, Op::none), {}, {}, {}};
    for (int i = 0; i < n; ++i) {
      program.linear.push_back(random.normal());  // has a part in the null space
      program.lower.push_back(-infinite);
      program.upper.push_back(infinite);
    }
    EXPECT_FALSE(solve(program).is_bounded) << k;
  }
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

std::vector<double> times(const Matrix& a, const std::vector<double>& x) {
  std::vector<double> y(a.rows(), 0.0);
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) y[i] += a(i, j) * x[j];
  return y;
}

/// A quadratic function x.A x / 2 + b.x of R^n with the inner product u.G v, seen by the steps through
/// representatives G^-1 of its derivatives.
struct Quadratic {
  Matrix metric, metric_inverse, hessian;  ///< hessian is A
  std::vector<double> b;

  Quadratic(int n, Random& random) : metric(n, n), metric_inverse(n, n), hessian(n, n), b(n) {
    const Matrix m = random.matrix(n, n), h = random.matrix(n, n);
    metric = product(m, Op::transpose, m, Op::none);
    hessian = product(h, Op::transpose, h, Op::none);
    for (int i = 0; i < n; ++i) {
      metric(i, i) += 1;
      hessian(i, i) += 0.1;
      metric_inverse(i, i) = 1;
      b[i] = random.normal();
    }
    Matrix copy = metric;
    EXPECT_TRUE(lu_solve(copy, metric_inverse));
  }

  double value(const std::vector<double>& x) const { return dot(x, times(hessian, x)) / 2 + dot(b, x); }
  std::vector<double> derivative(const std::vector<double>& x) const {
    auto g = times(hessian, x);
    for (size_t i = 0; i < g.size(); ++i) g[i] += b[i];
    return g;
  }
  std::vector<double> gradient(const std::vector<double>& x) const {
    return times(metric_inverse, derivative(x));
  }
  double inner(const std::vector<double>& u, const std::vector<double>& v) const {
    return dot(u, times(metric, v));
  }
  Matrix products(const std::vector<std::vector<double>>& vectors) const {
    const int n = static_cast<int>(vectors.size());
    Matrix result(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) result(i, j) = inner(vectors[i], vectors[j]);
    return result;
  }
};

std::vector<double> combined(const std::vector<double>& coefficients,
                             const std::vector<std::vector<double>>& vectors) {
  std::vector<double> sum(vectors.front().size(), 0.0);
  for (size_t k = 0; k < vectors.size(); ++k)
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += coefficients[k] * vectors[k][i];
  return sum;
}

/// The span of a gradient, of constraints, and of the pairs of random moves of a quadratic function.
struct Sampled {
  Quadratic function;
  std::vector<std::vector<double>> span;
  int n_pairs;

  Sampled(int n, int n_constraints, int pairs, Random& random) : function(n, random), n_pairs(pairs) {
    const auto vector = [&] {
      std::vector<double> v(n);
      for (double& x : v) x = random.normal();
      return v;
    };
    for (int k = 0; k < 1 + n_constraints; ++k) span.push_back(vector());
    for (int k = 0; k < pairs; ++k) span.push_back(vector());
    for (int k = 0; k < pairs; ++k)
      span.push_back(times(function.metric_inverse, times(function.hessian, span[1 + n_constraints + k])));
  }
};

// The secant equation, by the recursion of BFGS met by the newest pair; and the exact inverse on the span
// when the moves are conjugate, for which BFGS is exact.
TEST(ShiftedHessian, MeetsTheSecantEquationOfTheNewestPair) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const int pairs = 1 + random.below(6);
    const Sampled s(12, 1, pairs, random);
    const Matrix products = s.function.products(s.span);
    const ShiftedHessian hessian(products, 2, pairs, 0);
    std::vector<double> change(s.span.size(), 0.0);
    change.back() = 1;
    const auto move = combined(hessian.solve(change), s.span);
    for (size_t i = 0; i < move.size(); ++i)
      EXPECT_NEAR(move[i], s.span[1 + pairs][i], 1e-6 * (1 + std::abs(move[i])));
  }
}

/// B by the recursion B+ = B - B s (B s)^T / (s, B s) + y y^T / (y, s), as a matrix that acts on vectors. It
/// begins with the smallest curvature of the pairs.
Matrix bfgs_matrix(const Sampled& s, int first_move) {
  const int n = static_cast<int>(s.span.front().size());
  double scale = std::numeric_limits<double>::infinity();
  for (int k = 0; k < s.n_pairs; ++k) {
    const auto &move = s.span[first_move + k], &change = s.span[first_move + s.n_pairs + k];
    scale = std::min(scale, s.function.inner(change, change) / s.function.inner(change, move));
  }
  Matrix b(n, n);
  for (int i = 0; i < n; ++i) b(i, i) = scale;
  for (int k = 0; k < s.n_pairs; ++k) {
    const auto &move = s.span[first_move + k], &change = s.span[first_move + s.n_pairs + k];
    const auto image = times(b, move), dual_image = times(s.function.metric, image),
               dual_change = times(s.function.metric, change);
    const double down = dot(move, dual_image), up = dot(move, dual_change);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        b(i, j) += change[i] * dual_change[j] / up - image[i] * dual_image[j] / down;
  }
  return b;
}

TEST(ShiftedHessian, IsTheInverseOfTheRecursionOfBfgs) {
  Random random(4);
  for (int k = 0; k < 200; ++k) {
    const int pairs = random.below(6) + 1;
    const Sampled s(12, 2, pairs, random);
    const Matrix products = s.function.products(s.span);
    const double shift = random.one_in(2) ? 0 : std::abs(random.normal());
    const ShiftedHessian hessian(products, 3, pairs, shift);
    std::vector<double> coefficients(s.span.size());
    for (double& c : coefficients) c = random.normal();
    const auto solution = combined(hessian.solve(coefficients), s.span),
               given = combined(coefficients, s.span);
    auto back = times(bfgs_matrix(s, 3), solution);
    double size = 0;
    for (const double v : given) size = std::max(size, std::abs(v));
    for (size_t i = 0; i < back.size(); ++i)
      EXPECT_NEAR(back[i] + shift * solution[i], given[i], 1e-6 * size) << k;
  }
}

TEST(CurvatureMemory, ForgetsTheOldestAndRefusesNegativeCurvature) {
  CurvatureMemory memory;
  remember({{1}, {-1}}, 1, -1, 1, memory);
  EXPECT_TRUE(memory.empty());
  for (int k = 1; k <= 10; ++k) remember({{double(k)}, {1}}, double(k) * k, k, 1, memory);
  ASSERT_EQ(memory.size(), max_curvature_pairs);
  EXPECT_EQ(memory.back().move[0], 10);
  EXPECT_EQ(memory.front().move[0], 3);
}

/// A model of a random quadratic with constraints.
QuadraticModel model_of(const Sampled& s, std::vector<LinearConstraint> constraints) {
  const int first_move = 1 + static_cast<int>(constraints.size());
  return {.products = s.function.products(s.span),
          .constraints = std::move(constraints),
          .first_move = first_move,
          .n_pairs = s.n_pairs};
}

/// The optimality conditions of the step, in the full space: stationarity of the Lagrangian, signs of the
/// multipliers, complementarity, and a violation only where the multiplier is its penalty.
void expect_optimal(const Sampled& s, const QuadraticModel& model, const QuadraticStep& step) {
  const auto d = combined(step.coefficients, s.span);
  const Matrix b = model.n_pairs > 0 ? bfgs_matrix(s, model.first_move) : Matrix(12, 12);
  auto force = times(b, d);
  double size = 0;
  for (size_t i = 0; i < force.size(); ++i) {
    force[i] += step.shift * d[i] + s.span[0][i];
    size = std::max(size, std::abs(s.span[0][i]));
  }
  for (size_t k = 0; k < model.constraints.size(); ++k) {
    const auto& c = model.constraints[k];
    const auto& a = s.span[c.vector];
    const double x = step.multipliers[k];
    for (size_t i = 0; i < force.size(); ++i) force[i] += x * c.sign * a[i];
    size = std::max(size, std::abs(x));
    const double left = c.gap + c.bend + c.sign * s.function.inner(a, d),
                 small = 1e-6 * (1 + std::abs(c.gap) + std::abs(c.bend));
    EXPECT_NEAR(step.gaps[k], left, small);
    EXPECT_LE(x, c.penalty);
    EXPECT_GE(x, c.is_equality ? -c.penalty : 0);
    if (left > small) {
      EXPECT_EQ(x, c.penalty);
    }
    if (left < -small) {
      EXPECT_EQ(x, c.is_equality ? -c.penalty : 0);
    }
  }
  for (const double f : force) EXPECT_NEAR(f, 0, 1e-6 * (1 + size));
}

// Also with constraints that contradict each other: the same one twice, with other gaps.
TEST(QuadraticStep, MeetsTheOptimalityConditions) {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const int m = random.below(5), pairs = random.below(5);
    Sampled s(12, m, pairs, random);
    if (m > 1 && random.one_in(2)) s.span[2] = s.span[1];
    std::vector<LinearConstraint> constraints;
    for (int i = 0; i < m; ++i)
      constraints.push_back({.vector = 1 + i,
                             .sign = random.one_in(2) ? 1.0 : -1.0,
                             .gap = random.normal(),
                             .is_equality = random.one_in(3),
                             .bend = random.one_in(2) ? random.normal() : 0,
                             .penalty = std::abs(random.normal())});
    const QuadraticModel model = model_of(s, constraints);
    const double shift = pairs == 0 || random.one_in(2) ? std::abs(random.normal()) + 0.01 : 0;
    const QuadraticStep step = quadratic_step(model, shift);
    EXPECT_TRUE(step.is_feasible);
    double at_rest = 0;  // a step need not make up for the increase of the violation by the bends
    for (const auto& c : constraints)
      at_rest += c.penalty * (c.is_equality ? std::abs(c.bend) : std::max(c.bend, 0.0));
    EXPECT_GE(step.decrease, -1e-9 - at_rest);
    expect_optimal(s, model, step);
  }
}

TEST(QuadraticStep, SaysThatConstraintsOfInfinitePenaltyContradictEachOther) {
  Random random(6);
  Sampled s(12, 2, 1, random);
  s.span[2] = s.span[1];
  const auto with_gap = [&](double gap) {
    return quadratic_step(model_of(s, {{.vector = 1, .sign = 1, .gap = 1, .is_equality = true},
                                       {.vector = 2, .sign = 1, .gap = gap, .is_equality = true}}),
                          0.1);
  };
  EXPECT_TRUE(with_gap(1).is_feasible);
  EXPECT_FALSE(with_gap(2).is_feasible);
}

TEST(TrustRegionStep, IsAsLongAsAllowedOrTheWholeStep) {
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const int pairs = random.below(4);
    Sampled s(12, 1, pairs, random);
    const QuadraticModel model = model_of(s, {{.vector = 1,
                                               .sign = 1,
                                               .gap = random.normal(),
                                               .is_equality = random.one_in(2),
                                               .penalty = std::abs(random.normal())}});
    const double radius = std::abs(random.normal());
    const auto length = [&](const std::vector<double>& coefficients) {
      double largest = 0;
      for (const double v : combined(coefficients, s.span)) largest = std::max(largest, std::abs(v));
      return largest;
    };
    const QuadraticStep step = trust_region_step(model, radius, length);
    EXPECT_LE(length(step.coefficients), radius * (1 + 1e-12));
    if (step.shift > 0) {
      EXPECT_GE(length(step.coefficients), 0.97 * radius);
    }
    expect_optimal(s, model, step);
  }
}

}  // namespace
