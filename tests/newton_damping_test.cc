#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support.h"
#include "wheelwright/contact/contact_solver.h"

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
  int damped_set = 0;  ///< neither the residual's damping sufficed, nor did it take load steps
  int load_steps = 0;
  int failed = 0;
  int elsewhere = 0;  ///< converged to another solution
};

/// The attempts of solve_contact() each ask for their start: a first look, the attempt with the residual's
/// damping, the one with the contact set's, and then fractions of the load.
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
    int attempts = -1;
    bool in_load_steps = false;
    const auto state = solve_contact<2>(contact,
                                        [&](double fraction) {
                                          ++attempts;
                                          in_load_steps |= fraction < 1;
                                          return start;
                                        },
                                        {});
    starts.failed += !state;
    starts.load_steps += in_load_steps;
    starts.damped_set += attempts == 2 && !in_load_steps;
    starts.elsewhere += state && !(std::abs(state->rim.towards_ground - expected.towards_ground) <
                                   1e-8 * expected.towards_ground);
  }
  return starts;
}

void record(const Starts& starts) {
  ::testing::Test::RecordProperty("damped_set", starts.damped_set);
  ::testing::Test::RecordProperty("load_steps", starts.load_steps);
  ::testing::Test::RecordProperty("failed", starts.failed);
}

// Where most starts make Newton's method hop between contact sets, a step that changes few points converges.
TEST(NewtonDamping, SmallStepsInTheContactSetEndTheHopping) {
  auto model = model_near_sliding(0, 3);
  model.horizontal_force = 0.97 * friction * model.load;
  const Starts starts = from_random_starts(model, 60);
  record(starts);
  EXPECT_EQ(starts.failed, 0);
  EXPECT_EQ(starts.elsewhere, 0);
  EXPECT_GT(starts.damped_set, starts.total / 3);
  EXPECT_LT(starts.load_steps, starts.total / 10);
}

// A point whose sliding a step turned round sticks: then the residual's damping suffices.
TEST(NewtonDamping, PointsThatTurnRoundComeToRest) {
  for (const auto& [theta, gamma_0] : {std::pair{-1, 1.0}, {0, 3.0}, {1, 100.0}}) {
    auto model = model_near_sliding(theta, gamma_0);
    model.torque = 0.97 * friction * model.load * model.grid.outer_radius;
    const Starts starts = from_random_starts(model, 60);
    record(starts);
    EXPECT_EQ(starts.failed + starts.elsewhere, 0);
    EXPECT_LT(starts.damped_set + starts.load_steps, starts.total / 10) << theta;
  }
}

}  // namespace
}  // namespace wheelwright
