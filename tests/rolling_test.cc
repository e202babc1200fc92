#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "sensitivity/taylor_test.h"
#include "tests/support.h"

namespace wheelwright {
namespace {

using testing::generic_taylor_test;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;
using testing::strain_energy_alone;
using testing::with_theta;

// Two independent programs, one of them GetFEM, agree on these values to 1e-5.
TEST(Rolling, PaperWheelAgreesWithIndependentPrograms) {
  auto model = paper_model();
  model.ghost = {GhostPenaltyKind::paper, 1e-3};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(paper_holes(model.grid));
  ASSERT_TRUE(s) << s.failure().detail;
  EXPECT_NEAR(s->strain_energy[4], 6.96839, 2e-5 * 6.96839);  // a hole over the contact
  EXPECT_NEAR(s->states[4].rim.towards_ground, 0.583271e-3, 2e-5 * 0.583271e-3);
  EXPECT_NEAR(s->strain_energy[0], 4.22481, 2e-5 * 4.22481);  // a spoke over the contact
  EXPECT_NEAR(s->states[0].rim.towards_ground, 0.357684e-3, 2e-5 * 0.357684e-3);
  double sum = 0;
  for (double e : s->strain_energy) sum += e;
  EXPECT_NEAR(sum, 44.0451, 2e-5 * 44.0451);
}

TEST(Rolling, ContactQuadratureMatters) {
  auto model = paper_model();
  model.ghost = {GhostPenaltyKind::paper, 1e-3};
  for (const auto& [points, expected] : {std::pair{4, 44.0876}, {12, 44.0473}}) {
    model.contact_points = points;
    const auto e =
        evaluate<2>(*RollingProblem<2>::create(model), strain_energy_alone(), paper_holes(model.grid));
    ASSERT_TRUE(e);
    EXPECT_NEAR(e->objective, expected, 2e-5 * expected) << points;
  }
}

// The boundary expression (42) is the exact derivative of the discrete energy while the set of cut cells,
// ghost faces and contact points stays: the basis functions do not move with the boundary.
TEST(Rolling, ShapeGradientPassesTheTaylorTest) {
  for (double theta : {-1.0, 0.0, 1.0}) {
    const auto problem = RollingProblem<2>::create(with_theta(paper_model(14, 192), theta));
    ASSERT_TRUE(problem);
    const auto test = generic_taylor_test(*problem, strain_energy_alone());
    ASSERT_TRUE(test) << test.failure().detail;
    for (double order : test->orders) EXPECT_GT(order, 1.95) << theta;
  }
}

TEST(Rolling, TheSameBytesOnOneAndOnManyThreads) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  const auto evaluate_on = [&](int n_threads) {
    const ThreadLimit limit(n_threads);
    return *evaluate(*problem, testing::strain_energy_alone(), psi);
  };
  const auto one = evaluate_on(1), many = evaluate_on(4);
  EXPECT_EQ(one.objective, many.objective);
  ASSERT_EQ(one.gradient.size(), many.gradient.size());
  for (size_t i = 0; i < one.gradient.size(); ++i) EXPECT_EQ(one.gradient[i].value, many.gradient[i].value);
}

}  // namespace
}  // namespace wheelwright
