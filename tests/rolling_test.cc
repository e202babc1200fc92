#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support.h"

namespace wheelwright {
namespace {

using testing::holes;
using testing::paper_holes;
using testing::paper_model;

// Two independent programs, one of them GetFEM, agree on these values to 1e-5.
TEST(Rolling, PaperWheelAgreesWithIndependentPrograms) {
  auto model = paper_model();
  model.ghost = {GhostKind::paper, 1e-3};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(paper_holes(model.grid));
  ASSERT_TRUE(s) << s.failure().detail;
  EXPECT_NEAR(s->strain_energy[4], 6.96839, 2e-5 * 6.96839);  // a hole over the contact
  EXPECT_NEAR(s->states[4].rim_displacement, 0.583271e-3, 2e-5 * 0.583271e-3);
  EXPECT_NEAR(s->strain_energy[0], 4.22481, 2e-5 * 4.22481);  // a spoke over the contact
  EXPECT_NEAR(s->states[0].rim_displacement, 0.357684e-3, 2e-5 * 0.357684e-3);
  double sum = 0;
  for (double e : s->strain_energy) sum += e;
  EXPECT_NEAR(sum, 44.0451, 2e-5 * 44.0451);
}

TEST(Rolling, ContactQuadratureMatters) {
  auto model = paper_model();
  model.ghost = {GhostKind::paper, 1e-3};
  for (const auto& [points, expected] : {std::pair{4, 44.0876}, {12, 44.0473}}) {
    model.contact_points = points;
    const auto e = RollingProblem<2>::create(model)->evaluate(paper_holes(model.grid));
    ASSERT_TRUE(e);
    EXPECT_NEAR(e->objective, expected, 2e-5 * expected) << points;
  }
}

// The boundary expression (42) is the exact derivative of the discrete energy while the set of cut cells,
// ghost faces and contact points stays: the basis functions do not move with the boundary.
TEST(Rolling, ShapeGradientPassesTheTaylorTest) {
  for (double theta : {-1.0, 0.0, 1.0}) {
    auto model = paper_model(14, 192);
    model.contact.theta_nitsche = theta;
    model.contact.gamma_0 = theta == 1 ? 1000 : theta == 0 ? 10 : 1;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto& grid = model.grid;
    const auto psi = holes(grid, 2, {{0.2681, 0.47 * grid.sector_angle(), 0.0373}});
    std::vector<double> direction;
    for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
      const Vec<2> p = psi.lattice.polar_point(i);
      direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(40 * (p[0] - 0.27)));
    }
    const auto e = problem->evaluate(psi);
    ASSERT_TRUE(e) << e.failure().detail;
    double slope = 0;
    for (const auto& sample : e->gradient) {
      const ShapeFunctions<2> shape(2, sample.xi);
      const auto values = psi.cell_values(sample.cell);
      const auto change = LevelSet<2>{psi.lattice, direction}.cell_values(sample.cell);
      const CellMap<2> map(grid, 2, grid.cell_position(sample.cell));
      const Mat<2> inverse_jacobian = inverse<2>(map.jacobian(shape));
      Vec<2> gradient{};
      double d = 0;
      for (int a = 0; a < 9; ++a) {
        d += shape.value[a] * change[a];
        const Vec<2> g = transpose_times<2>(inverse_jacobian, shape.gradient[a]);
        for (int k = 0; k < 2; ++k) gradient[k] += values[a] * g[k];
      }
      slope -= sample.weight * sample.value * d / norm<2>(gradient);
    }
    std::vector<double> remainders;
    for (double t : {2e-5, 1e-5, 5e-6, 2.5e-6}) {
      auto moved = psi;
      for (size_t i = 0; i < direction.size(); ++i) moved.values[i] += t * direction[i];
      const auto trial = problem->evaluate(moved);
      ASSERT_TRUE(trial) << trial.failure().detail;
      remainders.push_back(std::abs(trial->objective - e->objective - t * slope));
    }
    printf("theta %g J %g slope %g remainders", theta, e->objective, slope);
    for (double r : remainders) printf(" %g", r);
    printf(" orders");
    for (size_t k = 0; k + 1 < remainders.size(); ++k)
      printf(" %.3f", std::log2(remainders[k] / remainders[k + 1]));
    printf("\n");
    for (size_t k = 0; k + 1 < remainders.size(); ++k)
      EXPECT_GT(std::log2(remainders[k] / remainders[k + 1]), 1.9) << theta;
  }
}

}  // namespace
}  // namespace wheelwright
