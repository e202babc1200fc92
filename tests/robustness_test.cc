#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "tests/support.h"

namespace wheelwright {
namespace {

using testing::Hole;
using testing::holes;
using testing::paper_model;

/// Draws shapes that are hard to cut: holes that nearly touch each other or a grid line, lie across the
/// sector's face, are smaller than a cell, and leave slivers of any size.
class ShapeGenerator {
 public:
  ShapeGenerator(const PolarGrid<2>& grid, unsigned seed) : grid_(grid), random_(seed) {}

  LevelSet<2> draw(int level_set_degree) {
    std::vector<Hole> all;
    const int n = 1 + static_cast<int>(uniform(0, 5));
    for (int k = 0; k < n; ++k) all.push_back(draw_hole(all));
    auto psi = holes(grid_, level_set_degree, all);
    if (chance(0.5)) put_a_node_on_the_boundary(psi);
    return psi;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  double h() const { return grid_.resolution(); }

  /// A length between 1e-10 h and h of either sign.
  double tiny() { return (chance(0.5) ? 1 : -1) * h() * std::pow(10, uniform(-10, 0)); }

  Hole draw_hole(const std::vector<Hole>& others) {
    const double row = grid_.cell_size()[0];
    const double lowest = grid_.inner_radius + 1.1 * row, highest = grid_.outer_radius - 2.1 * row;
    Hole hole;
    hole.radius = std::min(0.4 * h() * std::pow(15, uniform(0, 1)), 0.499 * (highest - lowest));
    hole.centre_radius = uniform(lowest + hole.radius, highest - hole.radius);
    hole.azimuth = chance(0.2) ? tiny() / 0.27 : uniform(0, grid_.sector_angle());
    const double kind = uniform(0, 1);
    if (kind < 0.25 && !others.empty()) {  // nearly tangent to another hole
      const Hole& other = others.back();
      const double distance = hole.radius + other.radius + tiny(), turn = uniform(0, 6.28);
      const Vec<2> c = cartesian<2>({other.centre_radius, other.azimuth});
      const Vec<2> x{c[0] + distance * std::cos(turn), c[1] + distance * std::sin(turn)};
      hole.centre_radius = norm<2>(x);
      hole.azimuth = std::atan2(x[1], x[0]);
    } else if (kind < 0.4) {  // nearly tangent to a circle of the grid
      const double edge = hole.centre_radius + hole.radius - grid_.inner_radius;
      hole.centre_radius += std::round(edge / row) * row - edge + tiny();
    } else if (kind < 0.55) {  // nearly tangent to a radius of the grid
      const double column = grid_.cell_size()[1], half_angle = std::asin(hole.radius / hole.centre_radius);
      hole.azimuth = std::round(hole.azimuth / column) * column - half_angle + tiny() / 0.27;
    }
    return hole;
  }

  /// Moves the level set so that a node near the boundary has a value between 1e-12 h and 1e-6 h.
  void put_a_node_on_the_boundary(LevelSet<2>& psi) {
    const double start = uniform(0, 1);
    const size_t n = psi.values.size();
    for (size_t k = 0; k < n; ++k) {
      const double value = psi.values[(static_cast<size_t>(start * n) + k) % n];
      if (std::abs(value) > 0.2 * h()) continue;
      const double shift = (chance(0.5) ? 1 : -1) * h() * std::pow(10, uniform(-12, -6)) - value;
      for (double& v : psi.values) v += shift;
      return;
    }
  }

  PolarGrid<2> grid_;
  std::mt19937 random_;
};

struct Checked {
  std::string complaint;  ///< empty when all is well
  double objective;
};

Checked check(const RollingProblem<2>& problem, const LevelSet<2>& psi) {
  const auto name = [](const Failure& f) { return std::string(to_string(f.reason)) + ": " + f.detail; };
  const auto s = problem.solve(psi);
  if (!s) return {name(s.failure()), 0};
  for (int i = 0; i < problem.model().n_positions; ++i) {
    if (!(s->strain_energy[i] > 0)) return {"strain energy " + std::to_string(s->strain_energy[i]), 0};
    double force = 0;
    for (int q = 0; q < s->contacts[i].n_points(); ++q)
      force += s->contacts[i].points()[q].weight * negative_part(s->states[i].augmented[q][0]);
    const double load = problem.model().load;
    if (!(std::abs(force - load) < 1e-9 * load)) return {"contact force " + std::to_string(force), 0};
  }
  const auto e = problem.differentiate(*s);
  if (!e) return {name(e.failure()), 0};
  if (e->gradient.empty()) return {"no gradient", 0};
  for (const auto& sample : e->gradient)
    if (!std::isfinite(sample.value)) return {"gradient not finite", 0};
  return {"", e->objective};
}

/// A shape whose material hangs together and is cut somewhere.
LevelSet<2> draw_attached(ShapeGenerator& generator, const RollingProblem<2>& problem, int level_set_degree) {
  while (true) {
    auto psi = generator.draw(level_set_degree);
    const auto domain = cut_domain(psi, problem.model().degree + 2);
    if (!domain) return psi;
    if (!domain->cut.empty() &&
        !check_attached(*domain, problem.protected_rim_rows, problem.protected_tread_rows))
      return psi;
  }
}

/// Evaluates random shapes, each of them twice: moved by 1e-6 of a cell, the energy must hardly change,
/// though slivers appear and vanish.
void expect_no_failure(int n_shapes, int degree, int level_set_degree) {
  auto model = paper_model(14, 192);
  model.degree = degree;
  model.n_positions = 2;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  ShapeGenerator generator(model.grid, 100 * degree + level_set_degree);
  for (int shape = 0; shape < n_shapes; ++shape) {
    SCOPED_TRACE("shape " + std::to_string(shape));
    auto psi = draw_attached(generator, *problem, level_set_degree);
    const Checked before = check(*problem, psi);
    ASSERT_EQ(before.complaint, "");
    for (double& value : psi.values) value += 1e-6 * model.grid.resolution();
    const Checked after = check(*problem, psi);
    ASSERT_EQ(after.complaint, "");
    EXPECT_NEAR(after.objective, before.objective, 1e-3 * before.objective);
  }
}

/// Degrees of the displacement and of the level set.
class RandomShapes : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(RandomShapes, NeverFail) { expect_no_failure(75, std::get<0>(GetParam()), std::get<1>(GetParam())); }

TEST_P(RandomShapes, NeverFailSlow) {
  expect_no_failure(1000, std::get<0>(GetParam()), std::get<1>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Degrees, RandomShapes,
                         ::testing::Combine(::testing::Values(1, 2), ::testing::Values(1, 2)));

}  // namespace
}  // namespace wheelwright
