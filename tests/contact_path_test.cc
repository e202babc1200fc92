#include "wheelwright/mechanics/contact/contact_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/random_wheels.h"
#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/contact/newton_tangent.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using testing::holes;

/// A driven wheel without symmetry, whose patch has points that stick and points that slide.
RollingModel<2> driven_model() {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, 0.12, 5, {14, 48}};
  model.materials = Material{30e6, 0.3};
  model.load = 2e4;
  model.n_positions = 1;
  model.tread.levels = 2;
  model.contact.friction = 0.4;
  model.horizontal_force = 0.2 * model.load;
  return model;
}

LevelSet<2> one_hole(const RollingModel<2>& model) {
  return holes(model.grid, 2, {{0.258, 0.3 * model.grid.sector_angle(), 0.042}});
}

double largest_difference(const ContactUnknowns<2>& a, const std::vector<Vec<2>>& tractions,
                          const ReducedContact<2>& contact) {
  double largest = 0;
  for (int i = 0; i < contact.n_points(); ++i)
    for (int d = 0; d < 2; ++d)
      largest =
          std::max(largest, std::abs(contact.response(i, a.augmented[i]).traction[d] - tractions[i][d]));
  return largest;
}

double peak(const std::vector<Vec<2>>& tractions) {
  double largest = 0;
  for (const auto& t : tractions) largest = std::max(largest, -t[0]);
  return largest;
}

// Newton's method finds the solution here, and the path, which does not use it, the same one.
TEST(ContactPath, LeadsFromAnyStartToNewtonsSolution) {
  const auto model = driven_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(one_hole(model));
  ASSERT_TRUE(s) << s.failure().detail;
  const ReducedContact<2>& contact = s->contacts[0];
  const ContactState<2>& state = s->states[0];
  int sticking = 0, sliding = 0;
  for (int i = 0; i < contact.n_points(); ++i) {
    const auto status = contact.status(i, state.augmented[i]);
    sticking += status.touches && !status.slides;
    sliding += status.slides;
  }
  ASSERT_GT(sticking, 3);
  ASSERT_GT(sliding, 3);

  const double disc = model.materials.at_tread().contact_modulus();
  std::vector<ContactUnknowns<2>> starts;
  for (const double load : {0.1, 1.0, 100.0})
    starts.push_back(hertz_start(contact, load * model.load, model.grid.outer_radius, disc));
  starts.push_back(touching(contact, undeformed_start(contact)));  // all but one point are open
  starts.push_back(start_from(contact, state));
  for (size_t k = 0; k < starts.size(); ++k) {
    const PathEnd<2> end = follow_path(contact, starts[k]);
    ASSERT_TRUE(end.arrives) << k;
    EXPECT_LT(largest_difference(end.x, state.traction, contact), 1e-7 * peak(state.traction)) << k;
    EXPECT_NEAR(end.x.rim[0], state.rim.towards_ground, 1e-9 * state.rim.towards_ground) << k;
  }
  // Between the shortest way and the longest one, more points change than one factored tangent corrects.
  EXPECT_LT(follow_path(contact, starts.back()).turns, 10);
  EXPECT_GT(follow_path(contact, starts[2]).turns, 64);
}

// Points that would turn round come to rest instead; else Newton's method cycles near the limit of friction,
// and the way round by paths takes hundreds of steps.
TEST(NewtonsMethod, NeedsFewStepsUpToTheLimitOfFriction) {
  auto model = driven_model();
  model.tread.levels = 3;
  for (const double nu : {0.0, 0.3})
    for (const double load : {2e4, 1e5})
      for (const double friction : {0.1, 0.3})
        for (const double share : {0.8, 0.95, 0.99}) {
          model.materials = Material{30e6, nu};
          model.load = load;
          model.contact.friction = friction;
          model.horizontal_force = share * friction * load;
          const auto problem = RollingProblem<2>::create(model);
          const auto s = problem->solve(one_hole(model));
          ASSERT_TRUE(s) << s.failure().detail;
          EXPECT_LE(s->states[0].newton_iterations, 25)
              << nu << " " << load << " " << friction << " " << share;
        }
}

TEST(ContactPath, StopsOnRequest) {
  const auto model = driven_model();
  const auto problem = RollingProblem<2>::create(model);
  const auto s = problem->solve(one_hole(model));
  ASSERT_TRUE(s) << s.failure().detail;
  const ReducedContact<2>& contact = s->contacts[0];
  const auto start = hertz_start(contact, 10 * model.load, model.grid.outer_radius,
                                 model.materials.at_tread().contact_modulus());
  const PathEnd<2> end = follow_path(contact, start, Interrupt([] { return true; }));
  EXPECT_FALSE(end.arrives);
  EXPECT_EQ(end.turns, 0);
}

/// The largest violation of Coulomb's law by the displacements of a state's touching points: sliding against
/// the traction, or friction beyond its bound, relative to the pressure's peak.
double violation(const ContactPatch<2>& patch, double friction) {
  double largest = 0, pressure = 0;
  for (const auto& point : patch.points) {
    const double p = -point.traction[0], q = std::abs(point.traction[1]);
    pressure = std::max(pressure, p);
    largest = std::max({largest, -p, q - friction * p});
    // z - Phi is the part of the augmented traction that the point gives way to: where it slides, it is in
    // the direction of the traction.
    const double slip = point.augmented[1] - point.traction[1];
    if (p > 0 && q < friction * p * (1 - 1e-9)) largest = std::max(largest, std::abs(slip));
    if (p > 0 && slip * point.traction[1] < 0) largest = std::max(largest, std::abs(slip));
  }
  return largest / pressure;
}

// This random wheel makes Newton's method cycle, and the sequence of problems with given friction too.
TEST(ContactPath, SolvesWhereNewtonsMethodCycles) {
  testing::RandomWheels wheels(1);
  for (int k = 0; k <= 51; ++k) {
    const Case c = wheels.draw();
    if (k != 51) continue;
    ASSERT_GT(c.contact.friction, 0.8);
    const auto solver = make_solver(rolling_model<2>(c));
    ASSERT_TRUE(solver);
    const LevelSet<2> shape = initial_shape<2>(c);
    const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), Interrupt());
    ASSERT_TRUE(state) << state.failure().detail;
    const auto problem = RollingProblem<2>::create(rolling_model<2>(c));
    const auto s = problem->solve(shape);
    ASSERT_TRUE(s) << s.failure().detail;
    for (const auto& position : s->states) EXPECT_LT(position.newton_iterations, 45);
    for (const auto& patch : (*state)->contacts()) {
      RimForce ground;
      for (const auto& point : patch.points) {
        ground.towards_ground += point.weight * point.traction[0];
        ground.along_ground += point.weight * point.traction[1];
      }
      const double load = (*solver)->model().load;
      EXPECT_NEAR(ground.towards_ground, -load, 1e-9 * load);
      EXPECT_NEAR(ground.along_ground, -(*solver)->model().horizontal_force, 1e-9 * load);
      EXPECT_LT(violation(patch, c.contact.friction), 1e-9);
    }
  }
}

// The correction of a factored tangent is the tangent where other points touch, stick and slide.
TEST(NewtonTangent, IsTheTangentOfEveryIterate) {
  const auto model = driven_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(one_hole(model));
  ASSERT_TRUE(s) << s.failure().detail;
  const ReducedContact<2>& contact = s->contacts[0];
  NewtonTangent<2> tangent(contact);
  const auto expect_equal_steps = [&](const ContactUnknowns<2>& x) {
    const auto residual = contact.residual(x);
    const auto corrected = tangent.step(x, residual);
    const auto factored = ContactTangent<2>::at(contact, x);
    ASSERT_TRUE(corrected && factored);
    const auto expected = factored->solve(residual);
    double size = 0, difference = 0;
    for (int i = 0; i < contact.n_points(); ++i)
      for (int d = 0; d < 2; ++d) {
        size = std::max(size, std::abs(expected.augmented[i][d]));
        difference = std::max(difference, std::abs(corrected->augmented[i][d] - expected.augmented[i][d]));
      }
    EXPECT_LT(difference, 1e-9 * size);
    for (size_t k = 0; k < expected.rim.size(); ++k)
      EXPECT_NEAR(corrected->rim[k], expected.rim[k], 1e-9 * std::abs(expected.rim[k]) + 1e-15);
  };
  ContactUnknowns<2> x = start_from(contact, s->states[0]);
  expect_equal_steps(x);
  const int n = contact.n_points();
  for (int changed = 1; changed < n; changed *= 3) {  // few points, and so many that it is factored again
    for (int i = 0; i < changed; ++i) {
      Vec<2>& z = x.augmented[(n / 2 + 7 * i) % n];
      z = i % 3 == 0 ? Vec<2>{std::abs(z[0]) + 1, 0} : Vec<2>{-std::abs(z[0]) - 1, i % 2 == 0 ? 1e9 : 0.0};
    }
    expect_equal_steps(x);
  }
}

}  // namespace
}  // namespace wheelwright
