#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_solver.h"

namespace wheelwright {
namespace {

using testing::Hole;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;

/// One to four holes that leave at least a centimetre of material between each other.
class ShapeGenerator {
 public:
  ShapeGenerator(const PolarGrid<2>& grid, unsigned seed) : grid_(grid), random_(seed) {}

  LevelSet<2> draw() {
    std::vector<Hole> all;
    const int n = 1 + static_cast<int>(uniform(0, 4));
    for (int attempt = 0; attempt < 50 && static_cast<int>(all.size()) < n; ++attempt) {
      const double radius = uniform(0.004, 0.04);
      const Hole hole{uniform(0.212 + radius, 0.318 - radius), uniform(0, grid_.sector_angle()), radius};
      if (is_apart(hole, all)) all.push_back(hole);
    }
    return holes(grid_, 2, all);
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  bool is_apart(const Hole& hole, std::vector<Hole> others) const {
    others.push_back(hole);
    for (const int image : {-1, 0, 1})
      for (size_t i = 0; i < others.size(); ++i) {
        if (image == 0 && i + 1 == others.size()) continue;
        const Vec<2> a = cartesian<2>({hole.centre_radius, hole.azimuth + image * grid_.sector_angle()});
        const Vec<2> b = cartesian<2>({others[i].centre_radius, others[i].azimuth});
        if (std::hypot(a[0] - b[0], a[1] - b[1]) < hole.radius + others[i].radius + 0.01) return false;
      }
    return true;
  }

  PolarGrid<2> grid_;
  std::mt19937 random_;
};

/// Contact methods with the gamma_0 that each needs, without friction and with it, rim held and driven.
std::vector<RollingModel<2>> all_models() {
  std::vector<RollingModel<2>> models;
  for (const auto& [theta, gamma_0] : {std::pair{-1, 1.0}, {0, 10.0}, {1, 100.0}})
    for (const int kind : {0, 1, 2, 3}) {
      auto model = paper_model(14, 192);
      model.contact = {.theta_nitsche = double(theta), .gamma_0 = gamma_0, .friction = kind > 0 ? 0.3 : 0};
      if (kind == 2) model.horizontal_force = 0.1 * model.load;
      if (kind == 3) model.torque = 0.1 * model.load * model.grid.outer_radius;
      models.push_back(model);
    }
  return models;
}

/// Solves random shapes, each with a contact method in turn, at all its load positions.
void expect_convergence(int n_shapes) {
  const auto models = all_models();
  std::vector<RollingProblem<2>> problems;
  for (const auto& model : models) {
    auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    problems.push_back(*std::move(problem));
  }
  ShapeGenerator shapes(models[0].grid, 5);
  std::vector<int> warm_iterations;
  int failures = 0;
  for (int k = 0; k < n_shapes; ++k) {
    const auto s = problems[k % problems.size()].solve(shapes.draw());
    if (!s) {
      ++failures;
      EXPECT_NE(s.failure().detail, "");
      ADD_FAILURE() << "shape " << k << ": " << s.failure().detail;
      continue;
    }
    for (size_t i = 1; i < s->states.size(); ++i) warm_iterations.push_back(s->states[i].newton_iterations);
  }
  std::sort(warm_iterations.begin(), warm_iterations.end());
  const int median = warm_iterations[warm_iterations.size() / 2];
  ::testing::Test::RecordProperty("median", median);
  ::testing::Test::RecordProperty("worst", warm_iterations.back());
  EXPECT_LE(failures, n_shapes / 1000);
  EXPECT_LE(median, 6);
}

/// A start that has nothing to do with the solution.
ContactUnknowns<2> random_start(const ReducedContact<2>& contact, std::mt19937& random) {
  std::uniform_real_distribution<double> pressure(-1e8, 1e8);
  ContactUnknowns<2> start{{}, std::vector<double>(contact.rim().free.size())};
  for (int i = 0; i < contact.n_points(); ++i)
    start.augmented.push_back({pressure(random), contact.friction() > 0 ? pressure(random) : 0});
  return start;
}

TEST(Newton, TheSolutionDoesNotDependOnTheStart) {
  std::mt19937 random(3);
  for (const auto& model : all_models()) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto s = problem->solve(paper_holes(model.grid));
    ASSERT_TRUE(s) << s.failure().detail;
    const ReducedContact<2>& contact = s->contacts[2];
    const RimMotion& expected = s->states[2].rim;
    for (int k = 0; k < 5; ++k) {
      const auto start = random_start(contact, random);
      const auto state = solve_contact<2>(contact, std::span(&start, 1));
      ASSERT_TRUE(state) << state.failure().detail;
      EXPECT_NEAR(state->rim.towards_ground, expected.towards_ground, 1e-9 * expected.towards_ground);
      EXPECT_NEAR(state->rim.along_ground, expected.along_ground, 1e-9 * expected.towards_ground);
      EXPECT_NEAR(state->rim.rotation * model.grid.outer_radius, expected.rotation * model.grid.outer_radius,
                  1e-9 * expected.towards_ground);
    }
  }
}

TEST(Newton, TravelAndLoadAreInverse) {
  for (const double friction : {0.0, 0.3}) {
    auto model = paper_model();
    model.contact.friction = friction;
    model.n_positions = 1;
    const auto psi = paper_holes(model.grid);
    const auto loaded = RollingProblem<2>::create(model)->solve(psi);
    ASSERT_TRUE(loaded);
    model.travel = loaded->states[0].rim.towards_ground;
    const auto pushed = RollingProblem<2>::create(model)->solve(psi);
    ASSERT_TRUE(pushed) << pushed.failure().detail;
    EXPECT_EQ(pushed->states[0].rim.towards_ground, *model.travel);
    EXPECT_NEAR(pushed->states[0].rim_force.towards_ground, model.load, 1e-9 * model.load);
    EXPECT_NEAR(pushed->strain_energy[0], loaded->strain_energy[0], 1e-9 * loaded->strain_energy[0]);
  }
}

TEST(Newton, NamesWhatIsImpossible) {
  auto model = paper_model(14, 192);
  const auto psi = paper_holes(model.grid);
  model.travel = -1e-4;
  const auto lifted = RollingProblem<2>::create(model)->solve(psi);
  ASSERT_FALSE(lifted);
  EXPECT_EQ(lifted.failure().reason, FailureReason::no_contact);

  model.travel.reset();
  model.contact.friction = 0.3;
  model.horizontal_force = 0.4 * model.load;
  const auto sliding = RollingProblem<2>::create(model)->solve(psi);
  ASSERT_FALSE(sliding);
  EXPECT_EQ(sliding.failure().reason, FailureReason::sliding);
}

// The patch of so light a wheel lies between the points of the contact: the nearest one carries the load.
TEST(Newton, LoadWithEmptyPatchReachesTheGround) {
  for (const double load : {1e-6, 1e-3, 1.0}) {
    auto model = paper_model(14, 192);
    model.n_positions = 7;
    model.load = load;
    model.tread.levels = 0;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    const auto s = problem->solve(holes(model.grid, 2, {{0.2581, 0.47 * model.grid.sector_angle(), 0.0273}}));
    ASSERT_TRUE(s) << s.failure().detail;
    for (const auto& state : s->states) {
      EXPECT_NEAR(state.rim_force.towards_ground, load, 1e-9 * load);
      EXPECT_GT(state.rim.towards_ground, 0);
      EXPECT_LE(std::ranges::count_if(state.traction, [](const Vec<2>& t) { return t[0] < 0; }), 2);
    }
  }
}

TEST(Newton, RandomShapesConverge) { expect_convergence(60); }

TEST(Newton, RandomShapesConvergeSlow) { expect_convergence(1000); }

}  // namespace
}  // namespace wheelwright
