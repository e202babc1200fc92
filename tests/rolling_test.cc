#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/rolling_ring.h"
#include "tests/support.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/rolling/position_tree.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"

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
  model.dilatation = DilatationKind::pointwise;
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
  model.dilatation = DilatationKind::pointwise;
  model.ghost = {GhostPenaltyKind::paper, 1e-3};
  for (const auto& [points, expected] : {std::pair{4, 44.0876}, {12, 44.0473}}) {
    model.contact_points = points;
    const auto e = testing::evaluate_objective<2>(*RollingProblem<2>::create(model), strain_energy_alone(),
                                                  paper_holes(model.grid));
    ASSERT_TRUE(e);
    EXPECT_NEAR(e->function("objective").value, expected, 2e-5 * expected) << points;
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

/// J_e and mean travel of a wheel.
std::pair<double, double> energy_and_travel(RollingModel<2> model, const LevelSet<2>& psi, double nu,
                                            int tread_levels) {
  model.materials = Material{200e6, nu};
  model.tread.levels = tread_levels;
  const auto s = RollingProblem<2>::create(model)->solve(psi);
  double energy = 0, travel = 0;
  for (const double e : s->strain_energy) energy += e;
  for (const auto& state : s->states) travel += state.rim.towards_ground / double(s->states.size());
  return {energy, travel};
}

/// J_e and mean travel of the paper's wheel.
std::pair<double, double> energy_and_travel(const RollingModel<2>& model, double nu, int tread_levels) {
  return energy_and_travel(model, testing::paper_holes(model.grid), nu, tread_levels);
}

/// A ring without holes, of the paper's dimensions and about its load, in parts of the exact solution:
/// travel, and the largest pressure at the contact points of 8 positions.
struct RollingRing {
  double travel, peak_pressure;
};

RollingRing ring_by_exact(RollingModel<2> model, double nu, DilatationKind dilatation, int tread_levels) {
  const Material material{200e6, nu};
  const auto exact = testing::RollingRingSeries(0.20, 0.34, material).at(0.0188);
  model.materials = material;
  model.load = exact.load;
  model.dilatation = dilatation;
  model.tread.levels = tread_levels;
  const auto s = RollingProblem<2>::create(model)->solve(testing::holes(model.grid, 2, {}));
  double travel = 0, peak = 0;
  for (size_t i = 0; i < s->states.size(); ++i) {
    travel += s->states[i].rim.towards_ground / double(s->states.size());
    for (const auto& traction : s->states[i].traction) peak = std::max(peak, -traction[0]);
  }
  return {travel / exact.travel, peak / exact.peak_pressure};
}

/// By default from nu = 0.48 on, and if it is asked for at every nu. The pointwise element locks at every nu,
/// less than this up to 0.3; the default is it up to 0.4.
TEST(Rolling, ARingIsAsSoftAsTheExactOneForEveryPoissonsRatio) {
  const auto error = [](double nu, DilatationKind dilatation) {
    RollingModel<2> model = paper_model(28, 384);
    model.n_positions = 1;
    return std::abs(ring_by_exact(model, nu, dilatation, 4).travel - 1);
  };
  for (const double nu : {0.0, 0.3, 0.4, 0.45, 0.48, 0.499, 0.4999})
    EXPECT_LT(error(nu, DilatationKind::projected), 5e-5) << nu;
  for (const double nu : {0.48, 0.485, 0.499, 0.4999})
    EXPECT_LT(error(nu, DilatationKind::automatic), 5e-5) << nu;
  for (const double nu : {0.4, 0.41, 0.45, 0.47}) EXPECT_LT(error(nu, DilatationKind::automatic), 2e-4) << nu;
  EXPECT_GT(error(0.48, DilatationKind::pointwise), 4e-4);
}

/// On cells of a third of the patch, by default and without the projection.
TEST(Rolling, PressuresOfARingOnCoarseTreadsAreThoseOfTheExactOne) {
  for (const int tread_levels : {1, 2}) {
    const auto error = [&](DilatationKind dilatation) {
      return std::abs(ring_by_exact(paper_model(28, 320), 0.48, dilatation, tread_levels).peak_pressure - 1);
    };
    EXPECT_LT(error(DilatationKind::automatic), tread_levels == 1 ? 0.06 : 0.01);
    EXPECT_GT(error(DilatationKind::pointwise), 0.1);
  }
}

/// The default does not jump where it begins to project, nor where all that ever is projected is.
TEST(Rolling, TravelIsContinuousInPoissonsRatio) {
  for (const double nu : {0.4, 0.48}) {
    const auto travel = [](double of_nu) { return energy_and_travel(paper_model(14, 192), of_nu, 1).second; };
    EXPECT_NEAR(travel(nu + 1e-9) / travel(nu), 1, 1e-5) << nu;
  }
}

// Free of locking: also on coarse grids the wheel is as soft as it is.
TEST(Rolling, NearlyIncompressibleWheelsAgreeWithFinerGrids) {
  for (const double nu : {0.49, 0.499, 0.4999})
    for (const int levels : {0, 2}) {
      const auto coarse = energy_and_travel(paper_model(28, 384), nu, levels);
      const auto fine = energy_and_travel(paper_model(56, 768), nu, levels);
      EXPECT_NEAR(coarse.first, fine.first, 3e-3 * fine.first) << nu << ", " << levels << " levels";
      EXPECT_NEAR(coarse.second, fine.second, 2e-3 * fine.second) << nu << ", " << levels << " levels";
    }
}

TEST(Rolling, ShapeGradientIsExactForNearlyIncompressibleMaterial) {
  for (const double nu : {0.49, 0.4999})
    for (const double theta : {-1.0, 0.0}) {
      auto model = with_theta(paper_model(14, 192), theta);
      model.materials = Material{200e6, nu};
      model.tread.levels = 1;
      model.cut_points = 12;
      const auto test = generic_taylor_test(*RollingProblem<2>::create(model), strain_energy_alone());
      ASSERT_TRUE(test) << test.failure().detail;
      for (const double order : test->orders) EXPECT_GT(order, 1.95) << nu << ", theta " << theta;
    }
}

TEST(Rolling, TheCellsOfAShapeCanBeGiven) {
  const auto problem = RollingProblem<2>::create(paper_model(14, 192));
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(problem->model().grid);
  const auto usual = cut_domain(psi, problem->model().points_in_cut_cells()), finer = cut_domain(psi, 8);
  const auto own = problem->solve(psi), given = problem->solve({psi, &*usual}),
             other = problem->solve({psi, &*finer});
  ASSERT_TRUE(own && given && other);
  EXPECT_EQ(given->strain_energy, own->strain_energy);
  EXPECT_NE(other->strain_energy, own->strain_energy);
}

// Three cells across a hole: the boundary bends much in a cell, and yet the usual rule knows the derivative.
TEST(Rolling, ShapeGradientIsExactOnACoarseGrid) {
  const auto model = paper_model(7, 128);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  for (const double centre : {0.26, 0.27}) {
    const auto psi = holes(model.grid, 2, {{centre, 0.5 * model.grid.sector_angle(), 0.0259}});
    const auto test = taylor_test<2>(
        [&](const LevelSet<2>& shape) {
          return testing::evaluate_objective<2>(*problem, strain_energy_alone(), shape);
        },
        psi, testing::smooth_direction(psi.lattice), model.degree, 1e-5, 3);
    ASSERT_TRUE(test) << test.failure().detail;
    for (double order : test->orders) EXPECT_GT(order, 1.99) << centre;
  }
}

// Rounding leaves 1e-15 or so; wrong numbers of one load case out of many, or of the harmonics, are found.
TEST(Rolling, TheEquationsOfASectorAreMetAndWrongNumbersInAnyLoadCaseAreFound) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(paper_holes(model.grid));
  ASSERT_TRUE(s) << s.failure().detail;
  const auto residual = [&](const SectorFields& displacement) {
    return interior_residual(s->ring, s->sweep, displacement, s->core_loads);
  };
  EXPECT_LT(residual(s->displacement), 1e-13);

  const SectorFields& good = s->displacement;
  const int n_modes = good.modes.rows(), n_cases = good.weights.rows();
  // One field more, which meets no equations: a displacement of single unknowns.
  SectorFields bad{Matrix(n_modes + 1, good.modes.columns()), Matrix(n_cases, n_modes + 1)};
  std::copy(good.weights.entries().begin(), good.weights.entries().end(), bad.weights.data());
  for (int i = 0; i < good.modes.columns(); ++i) {
    std::copy_n(good.modes.column(i), n_modes, bad.modes.column(i));
    if (s->sweep.visited[i]) bad.modes(n_modes, i) = i % 2 ? good.modes(0, i) : 0;
  }
  EXPECT_LT(residual(bad), 1e-13);
  for (const int wrong_case : {0, 1, n_cases / 2, n_cases - 1}) {
    bad.weights(wrong_case, n_modes) = 1e-6;
    EXPECT_GT(residual(bad), 1e-10) << wrong_case;
    bad.weights(wrong_case, n_modes) = NAN;
    EXPECT_TRUE(std::isnan(residual(bad))) << wrong_case;
    bad.weights(wrong_case, n_modes) = 0;
  }
  for (int j = 0; j < n_cases; ++j) bad.weights(j, n_modes) = 1e-6 * (j % 2 ? 1 : -1);
  EXPECT_GT(residual(bad), 1e-10) << "a harmonic whose sum over the sectors is zero";

  SectorFields loads{Matrix(1, good.modes.columns()), Matrix(n_cases, 1)};
  std::fill_n(loads.modes.data(), loads.modes.entries().size(), NAN);
  EXPECT_TRUE(std::isnan(interior_residual(s->ring, s->sweep, good, loads)));
}

TEST(Rolling, TheSameBytesOnOneAndOnManyThreads) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  const auto evaluate_on = [&](int n_threads) {
    const ThreadLimit limit(n_threads);
    return testing::evaluate_objective<2>(*problem, testing::strain_energy_alone(), psi)
        ->function("objective");
  };
  const auto one = evaluate_on(1), many = evaluate_on(4);
  EXPECT_EQ(one.value, many.value);
  EXPECT_EQ(one.gradient, many.gradient);
}

TEST(PositionTree, HoldsEveryPositionOnceAfterTheOneItStartsFrom) {
  for (int n = 1; n < 40; ++n) {
    std::vector<bool> is_solved(n, false);
    int n_solved = 0;
    for (const auto& generation : position_tree(n)) {
      for (const auto& [position, from] : generation) {
        EXPECT_FALSE(is_solved[position]);
        EXPECT_TRUE(from < 0 ? position == 0 : is_solved[from]) << n << ": " << position;
      }
      for (const auto& one : generation) is_solved[one.position] = true;
      n_solved += static_cast<int>(generation.size());
    }
    EXPECT_EQ(n_solved, n);
  }
}

// A driven wheel without symmetry, on one thread and on several.
TEST(RollingProblem, ContactsDoNotDependOnTheNumberOfThreads) {
  auto model = paper_model(7, 96);
  model.n_positions = 7;
  model.contact.friction = 0.3;
  model.horizontal_force = 0.1 * model.load;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto solved = [&](int n_threads) {
    const ThreadLimit limit(n_threads);
    auto s = problem->solve(holes(model.grid, 2, {{0.26, 0.3 * model.grid.sector_angle(), 0.03}}));
    if (!s) throw std::runtime_error(s.failure().detail);
    return std::move(s->observations);
  };
  EXPECT_EQ(solved(1).entries(), solved(4).entries());
}

}  // namespace
}  // namespace wheelwright
