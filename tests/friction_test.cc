#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_adjoint.h"
#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/rolling/adjoint.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

using testing::generic_taylor_test;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;
using testing::strain_energy_alone;
using testing::with_theta;

RollingModel<2> with_friction(RollingModel<2> model) {
  model.contact.friction = 0.3;
  return model;
}

RollingModel<2> braked(RollingModel<2> model) {
  model = with_friction(model);
  model.horizontal_force = 0.1 * model.load;
  return model;
}

RollingModel<2> driven(RollingModel<2> model) {
  model = with_friction(model);
  model.torque = -0.1 * model.load * model.grid.outer_radius;
  return model;
}

double total_energy(const RollingModel<2>& model, const LevelSet<2>& psi) {
  const auto problem = RollingProblem<2>::create(model);
  EXPECT_TRUE(problem);
  const auto s = problem->solve(psi);
  EXPECT_TRUE(s) << s.failure().detail;
  double sum = 0;
  for (double e : s->strain_energy) sum += e;
  return sum;
}

// At gamma_0 = 1000 all methods approximate the same problem closely.
TEST(Friction, ContactMethodsAgree) {
  for (const int levels : {0, 2}) {
    for (const double friction : {0.0, 0.3}) {
      auto model = paper_model();
      model.tread.levels = levels;
      model.contact.gamma_0 = 1000;
      model.contact.friction = friction;
      const auto psi = paper_holes(model.grid);
      const double reference = total_energy(model, psi);
      for (const double theta : {0.0, 1.0}) {
        model.contact.theta_nitsche = theta;
        EXPECT_NEAR(total_energy(model, psi), reference, 2e-3 * reference) << levels << friction << theta;
      }
      model.contact.method = ContactMethod::penalty;
      EXPECT_NEAR(total_energy(model, psi), reference, 2e-3 * reference) << levels << friction;
    }
  }
}

TEST(Friction, ForcesAndMomentsBalance) {
  for (const auto& model : {braked(paper_model()), driven(paper_model())}) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto s = problem->solve(paper_holes(model.grid));
    ASSERT_TRUE(s) << s.failure().detail;
    for (int i = 0; i < model.n_positions; ++i) {
      const auto& contact = s->contacts[i];
      const auto& state = s->states[i];
      RimForce ground;
      for (int q = 0; q < contact.n_points(); ++q) {
        const auto& point = contact.points()[q];
        const Vec<2>& t = state.traction[q];
        ground.towards_ground += point.weight * t[0];
        ground.along_ground += point.weight * t[1];
        ground.torque += point.weight * (point.position[0] * t[1] - point.position[1] * t[0]);
        EXPECT_LE(t[0], 0);
        EXPECT_LE(std::abs(t[1]), model.contact.friction * std::abs(t[0]) * (1 + 1e-14));
      }
      EXPECT_NEAR(ground.towards_ground, -model.load, 1e-9 * model.load);
      if (model.horizontal_force != 0) {
        EXPECT_NEAR(ground.along_ground, -model.horizontal_force, 1e-9 * model.load);
        EXPECT_EQ(state.rim.rotation, 0);
        EXPECT_NE(state.rim.along_ground, 0);
      }
      if (model.torque != 0) {
        EXPECT_NEAR(ground.torque, -model.torque, 1e-9 * model.load * model.grid.outer_radius);
        EXPECT_EQ(state.rim.along_ground, 0);
        EXPECT_NE(state.rim.rotation, 0);
      }
    }
  }
}

/// A wheel without symmetry, whose patch is not centred below the axle.
RollingModel<2> lopsided_model() {
  auto model = with_friction(paper_model(14, 192));
  model.tread.levels = 2;
  return model;
}

// Up to 99 % of what friction holds, by forces and torques in both directions.
TEST(Friction, ResistsSlidingUpToItsLimit) {
  for (const double friction : {0.05, 0.3, 1.0})
    for (const double part : {-0.99, -0.82, 0.9, 0.99})
      for (const bool is_torque : {false, true}) {
        auto model = lopsided_model();
        model.contact.friction = friction;
        const double held = part * friction * model.load;
        (is_torque ? model.torque : model.horizontal_force) =
            held * (is_torque ? model.grid.outer_radius : 1);
        const auto problem = RollingProblem<2>::create(model);
        ASSERT_TRUE(problem);
        const auto s = problem->solve(testing::generic_hole(model.grid));
        // Where the patch lies off the axle, the pressure takes a part of the torque, or adds to it.
        if (!s && is_torque && std::abs(part) == 0.99) {
          EXPECT_EQ(s.failure().reason, FailureReason::sliding) << friction << part << s.failure().detail;
          continue;
        }
        ASSERT_TRUE(s) << friction << part << is_torque << s.failure().detail;
        for (const auto& state : s->states) {
          if (is_torque)
            EXPECT_NEAR(state.rim_force.torque, model.torque, 1e-9 * std::abs(model.torque));
          else
            EXPECT_NEAR(state.rim_force.along_ground, held, 1e-9 * std::abs(held));
        }
      }
}

// The limit is what a contact holds that slides everywhere: the friction of the load, to the last newton.
TEST(Friction, BeyondItsLimitTheWheelSlides) {
  for (const double part : {0.9999, 1.0001}) {
    auto model = lopsided_model();
    model.horizontal_force = part * 0.3 * model.load;
    const auto s = RollingProblem<2>::create(model)->solve(testing::generic_hole(model.grid));
    if (s) {
      EXPECT_LT(part, 1);
      continue;
    }
    EXPECT_EQ(s.failure().reason, FailureReason::sliding) << s.failure().detail;
  }
  auto model = lopsided_model();
  model.distributed.body_force[1] =
      0.4 * model.load / material_measure(testing::generic_hole(model.grid)) / 16;
  model.horizontal_force = 1e-3 * model.load;
  const auto pushed = RollingProblem<2>::create(model)->solve(testing::generic_hole(model.grid));
  ASSERT_FALSE(pushed);
  EXPECT_EQ(pushed.failure().reason, FailureReason::sliding) << pushed.failure().detail;
  EXPECT_NE(pushed.failure().detail.find("load.body_force"), std::string::npos);
}

// At a prescribed travel the force of the ground is a result, and what friction holds follows from it.
TEST(Friction, AWheelAtAPrescribedTravelSlidesWhereItsForceIsTooSmall) {
  auto model = lopsided_model();
  model.travel = 2e-4;
  const auto psi = testing::generic_hole(model.grid);
  const auto free = RollingProblem<2>::create(model)->solve(psi);
  ASSERT_TRUE(free) << free.failure().detail;
  double minimum = 1e300;
  for (const auto& state : free->states) minimum = std::min(minimum, state.rim_force.towards_ground);
  for (const double part : {0.9, 1.1}) {
    model.torque = part * 0.3 * minimum * model.grid.outer_radius;
    const auto driven = RollingProblem<2>::create(model)->solve(psi);
    if (part < 1) {
      EXPECT_TRUE(driven) << driven.failure().detail;
      continue;
    }
    ASSERT_FALSE(driven);
    EXPECT_EQ(driven.failure().reason, FailureReason::sliding) << driven.failure().detail;
    EXPECT_NE(driven.failure().detail.find("load.torque"), std::string::npos);
    EXPECT_NE(driven.failure().detail.find("load.travel"), std::string::npos);
  }
}

// Without a force along the ground friction only hinders the tread from spreading.
TEST(Friction, ASymmetricWheelStaysSymmetric) {
  const auto model = with_friction(paper_model());
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = paper_holes(model.grid);
  const auto s = problem->solve(psi);
  ASSERT_TRUE(s) << s.failure().detail;
  for (int i = 1; i < 4; ++i)
    EXPECT_NEAR(s->strain_energy[i], s->strain_energy[8 - i], 1e-9 * s->strain_energy[i]);
  for (const int i : {0, 4}) {
    const auto& traction = s->states[i].traction;
    double peak = 0;
    for (const auto& t : traction) peak = std::max(peak, -t[0]);
    for (size_t q = 0; q < traction.size(); ++q) {
      const auto& mirrored = traction[traction.size() - 1 - q];
      EXPECT_NEAR(traction[q][0], mirrored[0], 1e-8 * peak);
      EXPECT_NEAR(traction[q][1], -mirrored[1], 1e-8 * peak);
    }
    EXPECT_NEAR(s->states[i].rim_force.along_ground, 0, 1e-9 * model.load);
  }
  const double without = total_energy(paper_model(), psi), with = total_energy(model, psi);
  EXPECT_LT(with, without);
  EXPECT_GT(with, 0.97 * without);
}

TEST(Friction, ForceAndTorqueActAlongLargerAzimuth) {
  auto model = braked(paper_model(14, 192));
  const auto psi = paper_holes(model.grid);
  const auto forward = RollingProblem<2>::create(model)->solve(psi);
  model.horizontal_force = -model.horizontal_force;
  const auto back = RollingProblem<2>::create(model)->solve(psi);
  ASSERT_TRUE(forward);
  ASSERT_TRUE(back);
  EXPECT_GT(forward->states[0].rim.along_ground, 0);
  EXPECT_NEAR(forward->states[0].rim.along_ground, -back->states[0].rim.along_ground,
              1e-9 * forward->states[0].rim.along_ground);
}

/// Loads of the ground after a change of what the tread would show without it.
Matrix loads_under(const RollingProblem<2>& problem, const RollingSolution<2>& s, int position,
                   const Preload& preload) {
  const auto rolled = roll_to<2>(problem.model(), problem.tread(), s.ring, *s.surface,
                                 s.positions.grounds[position], preload, s.states[position]);
  EXPECT_TRUE(rolled) << rolled.failure().detail;
  EXPECT_EQ(rolled->contact.n_points(), s.contacts[position].n_points());
  for (int q = 0; q < rolled->contact.n_points(); ++q)
    EXPECT_TRUE(contact_status<2>(rolled->state.augmented[q], rolled->contact.friction()) ==
                contact_status<2>(s.states[position].augmented[q], rolled->contact.friction()));
  return contact_loads(rolled->contact, rolled->state);
}

double product(const Matrix& a, const Matrix& b) {
  double sum = 0;
  for (int j = 0; j < a.columns(); ++j)
    for (int i = 0; i < a.rows(); ++i) sum += a(i, j) * b(i, j);
  return sum;
}

// In 2D the contact law is linear between changes of status, so differences are derivatives: the adjoint maps
// observations to loads by the transpose of what the direct problem does.
TEST(Friction, TheAdjointIsTheTransposeOfTheTangent) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& model :
       {with_friction(paper_model(14, 192)), braked(paper_model(14, 192)), driven(paper_model(14, 192))}) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto s = problem->solve(paper_holes(model.grid));
    ASSERT_TRUE(s) << s.failure().detail;
    const int n_rows = problem->tread().n_observations(),
              n_contact = problem->tread().observation_rows().n_contact();
    const int n_columns = model.grid.ring_columns();
    for (const int position : {1, 2, 4}) {
      const ReducedContact<2>& contact = s->contacts[position];
      const int first = contact.zone().first_column, n_zone = contact.zone().n_columns;
      Matrix change(n_contact, n_zone), observed(n_contact, n_zone);
      for (int c = 0; c < n_zone; ++c)
        for (int row = 0; row < n_contact; ++row) {
          change(row, c) = (row % 4 < 2 ? 1e-9 : 1e2) * uniform(random);
          observed(row, c) = (row % 4 < 2 ? 1 : 1e10) * uniform(random);
        }
      Matrix difference;
      for (const double sign : {1.0, -1.0}) {
        Preload preload{Matrix(n_rows, n_columns), {}};
        for (int c = 0; c < n_zone; ++c)
          for (int row = 0; row < n_contact; ++row)
            preload.observations(row, (first + c + n_columns) % n_columns) = sign * change(row, c);
        const Matrix loads = loads_under(*problem, *s, position, preload);
        if (difference.rows() == 0) difference = Matrix(loads.rows(), loads.columns());
        for (size_t k = 0; k < loads.entries().size(); ++k)
          difference.entries()[k] += 0.5 * sign * loads.entries()[k];
      }
      const ContactAdjointLoads<2> loads_of_adjoint{observed};
      const auto adjoint =
          contact_multipliers<2>(contact, s->states[position], std::span(&loads_of_adjoint, 1));
      ASSERT_TRUE(adjoint);
      const double direct = product(observed, difference),
                   transposed = product(adjoint->front().loads, change);
      EXPECT_NEAR(direct, transposed, 1e-10 * std::abs(direct));
    }
  }
}

// The energy is quadratic in the load between changes of status, so a central difference is its derivative:
// what the load does on the adjoint's rim motion, with a minus.
TEST(Friction, TheAdjointPredictsTheEffectOfTheLoad) {
  for (const auto& model :
       {with_friction(paper_model(14, 192)), braked(paper_model(14, 192)), driven(paper_model(14, 192))}) {
    const auto psi = paper_holes(model.grid);
    const auto problem = RollingProblem<2>::create(model);
    const auto s = problem->solve(psi);
    ASSERT_TRUE(s) << s.failure().detail;
    const FunctionalDerivative<2> energy{
        .energy = std::vector<double>(s->positions.size(), 1.0), .tread_loads = {}, .integrals = {}};
    const auto adjoints = solve_adjoints<2>(*problem, *s, std::span(&energy, 1));
    ASSERT_TRUE(adjoints);
    double derivative = 0;
    for (const RimMotion& rim : adjoints->front().rim) derivative -= rim.towards_ground;
    const double change = 1e-4 * model.load;
    auto more = model, less = model;
    more.load += change;
    less.load -= change;
    const double difference = (total_energy(more, psi) - total_energy(less, psi)) / (2 * change);
    EXPECT_NEAR(derivative, difference, 1e-8 * std::abs(difference));
  }
}

TEST(Friction, ShapeGradientPassesTheTaylorTest) {
  for (const auto& base :
       {braked(paper_model(14, 192)), driven(paper_model(14, 192)), with_friction(paper_model(14, 192))}) {
    for (const double theta : {-1.0, 0.0, 1.0}) {
      const auto problem = RollingProblem<2>::create(with_theta(base, theta));
      ASSERT_TRUE(problem);
      const auto test = generic_taylor_test(*problem, strain_energy_alone());
      ASSERT_TRUE(test) << test.failure().detail;
      for (double order : test->orders) EXPECT_GT(order, 1.9) << theta;
    }
  }
}

TEST(Friction, ShapeGradientOfThePapersWheelPassesTheTaylorTest) {
  auto model = with_friction(paper_model());
  model.torque = 100 / model.grid.width;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto test = generic_taylor_test(*problem, strain_energy_alone());
  ASSERT_TRUE(test) << test.failure().detail;
  for (double order : test->orders) EXPECT_GT(order, 1.9);
}

}  // namespace
}  // namespace wheelwright
