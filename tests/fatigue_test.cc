// How close the material is to its fatigue limit, in wheels: derivatives, invariances, keys.

#include "wheelwright/quantities/functionals/fatigue.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/mechanics/elasticity/orthotropic_law.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/quantities/analysis/fatigue_results.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using testing::generic_hole;
using testing::paper_model;

FatigueStrength strength(FatigueMeasure measure) {
  const bool is_of_strain = measure == FatigueMeasure::principal_strain,
             is_of_energy = measure == FatigueMeasure::strain_energy;
  return {.measure = measure,
          .limit = is_of_strain   ? 0.02
                   : is_of_energy ? 2e4
                                  : 2e6,
          .cycles = 1e6,
          .exponent = 4,
          .pressure_factor = 0.3,
          .ultimate_strength = 2e7};
}

Material tired(FatigueMeasure measure, Plane plane = Plane::strain) {
  Material material{200e6, 0.35, plane};
  material.fatigue = strength(measure);
  return material;
}

constexpr FatigueMeasure all_measures[] = {FatigueMeasure::crossland, FatigueMeasure::dang_van,
                                           FatigueMeasure::goodman, FatigueMeasure::principal_strain,
                                           FatigueMeasure::strain_energy};

/// Driven, with friction and loads on the structure: without any symmetry.
RollingModel<2> lopsided_model(const Materials<2>& materials) {
  auto model = paper_model(14, 192);
  model.materials = materials;
  model.n_positions = 4;
  // The derivative of an integral over cut cells is exact up to their quadrature. Dang Van's measure wants so
  // many points: the center of the path of the stresses changes fast from point to point.
  model.cut_points = 12;
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed = {{3e4, 1e4}, 1e4};
  return model;
}

/// With the correction of the norm held, of which it is the derivative.
template <int dim>
WeightedSum<dim> utilization_norm(const RollingModel<dim>& model) {
  return {{1, std::make_shared<FatigueUtilization<dim>>(model.materials, std::nullopt, PeakNorm{4, 1.0})}};
}

template <int dim>
TaylorTest tested(const RollingModel<dim>& model, const LevelSet<dim>& psi,
                  std::span<const double> direction) {
  const auto problem = RollingProblem<dim>::create(model);
  if (!problem) throw std::runtime_error(problem.failure().detail);
  const auto test = taylor_test<dim>(
      [&](const LevelSet<dim>& shape) {
        return testing::evaluate_objective<dim>(*problem, utilization_norm<dim>(model), shape);
      },
      psi, direction, model.degree, 2e-5, 3);
  if (!test) throw std::runtime_error(test.failure().detail);
  return *test;
}

/// What remains at the smallest step, by the change there.
double error_of_derivative(const TaylorTest& test) {
  return test.remainders.back() / std::abs(test.derivative * test.steps.back());
}

TEST(Fatigue, PassesTheTaylorTest) {
  for (const FatigueMeasure measure : all_measures)
    for (const Plane plane : {Plane::strain, Plane::stress}) {
      SCOPED_TRACE(static_cast<int>(measure));
      const auto model = lopsided_model(tired(measure, plane));
      const auto psi = generic_hole(model.grid);
      const TaylorTest test = tested<2>(model, psi, testing::smooth_direction(psi.lattice));
      for (const double order : test.orders) EXPECT_GT(order, 1.9);
      EXPECT_LT(error_of_derivative(test), 5e-4);
    }
}

/// Layers have measures of their own, one an orthotropic material.
TEST(Fatigue, OfLayersPassesTheTaylorTest) {
  OrthotropicMaterial band{.modulus_r = 300e6,
                           .modulus_t = 900e6,
                           .modulus_z = 300e6,
                           .ratio_rt = 0.1,
                           .ratio_rz = 0.3,
                           .ratio_tz = 0.3,
                           .shear_rt = 150e6};
  band.fatigue = strength(FatigueMeasure::crossland);
  const auto isotropic = [](FatigueMeasure measure) {
    return std::make_shared<const IsotropicLaw<2>>(tired(measure));
  };
  const auto model =
      lopsided_model(Materials<2>({{0.25, isotropic(FatigueMeasure::dang_van), "inside"},
                                   {0.29, std::make_shared<const OrthotropicLaw<2>>(band), "band"},
                                   {0.34, isotropic(FatigueMeasure::strain_energy), "tread"}}));
  const auto psi = generic_hole(model.grid);
  const TaylorTest test = tested<2>(model, psi, testing::smooth_direction(psi.lattice));
  for (const double order : test.orders) EXPECT_GT(order, 1.9);
}

RollingModel<3> solid_model(int axial_cells) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, axial_cells}};
  model.degree = 1;
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  return model;
}

/// With friction and a torque, not its own mirror image in any plane.
TaylorTest tested_in_3d(FatigueMeasure measure, int cut_points) {
  auto model = solid_model(2);
  model.materials = tired(measure);
  model.cut_points = cut_points;
  model.contact.friction = 0.5;
  model.torque = 120;
  model.lateral_force = 350;
  const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0273};
  auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    psi.values[i] += 0.002 * std::cos(20 * p[2]);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  return tested<3>(model, psi, direction);
}

TEST(Fatigue, PassesTheTaylorTestIn3D) {
  for (const double order : tested_in_3d(FatigueMeasure::principal_strain, 4).orders) EXPECT_GT(order, 1.9);
  EXPECT_LT(error_of_derivative(tested_in_3d(FatigueMeasure::dang_van, 8)), 5e-4);
}

TEST(Fatigue, OfDangVanPassesTheTaylorTestIn3DSlow) {
  for (const double order : tested_in_3d(FatigueMeasure::dang_van, 16).orders) EXPECT_GT(order, 1.9);
}

template <int dim>
FatigueResults results(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                       const LoadPositions& positions) {
  const auto state = solver.states(psi, positions, Interrupt());
  if (!state) throw std::runtime_error(state.failure().detail);
  return **fatigue_results<dim>(solver, psi, **state);
}

TEST(Fatigue, OfHalfOfTheWidthIsThatOfTheWhole) {
  auto model = solid_model(4);
  model.materials = tired(FatigueMeasure::crossland);
  const auto whole = RollingProblem<3>::create(model);
  const auto half = HalfWidthSolver::create(model);
  ASSERT_TRUE(whole && half);
  const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0273};
  const auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  EXPECT_NEAR(results<3>(**half, psi, (*half)->all_positions()).worst.utilization /
                  results<3>(*whole, psi, whole->all_positions()).worst.utilization,
              1, 1e-7);
}

/// The wheel that begins at another column, and its mirror image, are as far from the limit.
TEST(Fatigue, IsThatOfAnyOtherSectorAndOfTheImage) {
  for (const FatigueMeasure measure : all_measures) {
    auto model = paper_model(14, 192);
    model.n_positions = 4;
    model.materials = tired(measure);
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const double a = model.grid.sector_angle(), column = a / model.grid.cells[1];
    const auto turned = [&](double by, double sign) {
      const auto psi = testing::holes(
          model.grid, 2, {{0.2513, sign * 0.04 * a + by, 0.0213}, {0.2731, sign * 0.53 * a + by, 0.0267}});
      return results<2>(*problem, psi, problem->all_positions()).worst.utilization;
    };
    const double here = turned(0, 1);
    EXPECT_NEAR(turned(3 * column, 1), here, 1e-8 * here);
    EXPECT_NEAR(turned(a, -1), here, 1e-8 * here);
  }
}

// Positions of a symmetric wheel that stand for their images do not suffice; fatigue_results() solves all.
TEST(Fatigue, OfASymmetricWheelNeedsAllPositions) {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  model.materials = tired(FatigueMeasure::dang_van);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  const auto distinct = problem->distinct_positions(psi);
  ASSERT_TRUE(distinct.stand_for_images());
  const FatigueResults half = results<2>(*problem, psi, distinct),
                       all = results<2>(*problem, psi, problem->all_positions());
  EXPECT_NEAR(half.worst.utilization, all.worst.utilization, 1e-9 * all.worst.utilization);
  EXPECT_NEAR(*all.worst.life, 1e6 * std::pow(all.worst.utilization, -4), 1e-9 * *all.worst.life);
}

/// Under twice the load with the contact held by bonding, stresses double and life falls by 2^k; the energy
/// measure is quadratic.
TEST(Fatigue, FollowsTheCurveOfWoehler) {
  for (const FatigueMeasure measure : {FatigueMeasure::crossland, FatigueMeasure::strain_energy}) {
    FatigueResults of_load[2];
    for (const int doubled : {0, 1}) {
      auto model = testing::paper_model(14, 192);
      model.contact.counterpart = Counterpart::ring;
      model.contact_points = 3;
      model.n_positions = 2;
      model.load = 1000 << doubled;
      model.materials = tired(measure);
      const auto problem = RollingProblem<2>::create(model);
      ASSERT_TRUE(problem) << problem.failure().detail;
      of_load[doubled] = results<2>(*problem, testing::paper_holes(model.grid), problem->all_positions());
    }
    const double factor = measure == FatigueMeasure::strain_energy ? 4 : 2;
    EXPECT_NEAR(of_load[1].worst.utilization / of_load[0].worst.utilization, factor, 1e-9 * factor);
    EXPECT_NEAR(*of_load[0].worst.life / *of_load[1].worst.life, std::pow(factor, 4),
                1e-7 * std::pow(factor, 4));
  }
}

TEST(Fatigue, KeysMustFitTheMeasure) {
  const auto problems = [](const std::string& keys) {
    return parse_case("[material]\n" + keys + "[load]\nforce = 2000\n", "case.toml").problems;
  };
  EXPECT_TRUE(
      problems("fatigue_measure = \"crossland\"\nfatigue_limit = 2e6\nfatigue_pressure_factor = 0.3\n")
          .empty());
  EXPECT_TRUE(problems("fatigue_measure = \"principal_strain\"\nfatigue_strain = 0.02\n").empty());
  EXPECT_EQ(problems("fatigue_measure = \"goodman\"\n").size(), 2);
  EXPECT_EQ(
      problems("fatigue_measure = \"strain_energy\"\nfatigue_limit = 2e4\nultimate_strength = 2e7\n").size(),
      1);
  EXPECT_EQ(problems("fatigue_limit = 2e6\nfatigue_exponent = 5\n").size(), 2);
  EXPECT_EQ(
      parse_case("[load]\nforce = 2000\n[[constraint]]\nquantity = \"fatigue_utilization\"\nat_most = 0.9\n",
                 "case.toml")
          .problems.size(),
      1);
}

}  // namespace
}  // namespace wheelwright
