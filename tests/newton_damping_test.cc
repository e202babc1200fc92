#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_solver.h"

namespace wheelwright {
namespace {

using testing::paper_holes;
using testing::paper_model;

constexpr double friction = 0.1;

/// A contact form under which Newton's method has something to do, 3 % below the limit of friction.
RollingModel<2> model_near_sliding(double theta, double gamma_0) {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  model.contact = {.theta_nitsche = theta, .gamma_0 = gamma_0, .friction = friction};
  return model;
}

/// What a number of random starts, from soft to far too hard, needed.
struct Starts {
  int total = 0;
  int failed = 0;
  int elsewhere = 0;            ///< converged to another solution
  std::vector<int> iterations;  ///< ascending

  int median() const { return iterations[iterations.size() / 2]; }
};

Starts from_random_starts(const RollingModel<2>& model, int n) {
  std::mt19937 random(7);
  const auto problem = RollingProblem<2>::create(model);
  const auto s = problem->solve(paper_holes(model.grid));
  EXPECT_TRUE(s) << s.failure().detail;
  const ReducedContact<2>& contact = s->contacts[1];
  const RimMotion& expected = s->states[1].rim;
  Starts starts;
  for (; starts.total < n; ++starts.total) {
    const double scale = std::pow(10., std::uniform_real_distribution<double>(5, 9)(random));
    std::uniform_real_distribution<double> pressure(-scale, scale);
    ContactUnknowns<2> start{{}, std::vector<double>(contact.rim().free.size())};
    for (int i = 0; i < contact.n_points(); ++i)
      start.augmented.push_back({pressure(random), pressure(random)});
    const auto state = solve_contact<2>(contact, std::span(&start, 1));
    if (!state) {
      ++starts.failed;
      continue;
    }
    starts.elsewhere +=
        !(std::abs(state->rim.towards_ground - expected.towards_ground) < 1e-8 * expected.towards_ground);
    starts.iterations.push_back(state->newton_iterations);
  }
  std::ranges::sort(starts.iterations);
  return starts;
}

void expect_few_iterations(const RollingModel<2>& model) {
  const Starts starts = from_random_starts(model, 60);
  EXPECT_EQ(starts.failed, 0);
  EXPECT_EQ(starts.elsewhere, 0);
  ::testing::Test::RecordProperty("median", starts.median());
  ::testing::Test::RecordProperty("worst", starts.iterations.back());
  EXPECT_LE(starts.median(), 20);
  EXPECT_LE(starts.iterations.back(), 100);
}

// Most starts make Newton's method hop between contact sets.
TEST(NewtonDamping, HoppingBetweenContactSetsEnds) {
  auto model = model_near_sliding(0, 3);
  model.horizontal_force = 0.97 * friction * model.load;
  expect_few_iterations(model);
}

// A point whose sliding a step turned round sticks, and where all slide one sticks again.
TEST(NewtonDamping, ReversingPointsComeToRest) {
  for (const auto& [theta, gamma_0] : {std::pair{-1, 1.0}, {0, 3.0}, {1, 100.0}}) {
    auto model = model_near_sliding(theta, gamma_0);
    model.torque = 0.97 * friction * model.load * model.grid.outer_radius;
    expect_few_iterations(model);
  }
}

}  // namespace
}  // namespace wheelwright
