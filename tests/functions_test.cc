#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/functionals/boundary_integral.h"
#include "wheelwright/quantities/functionals/material_density_integral.h"
#include "wheelwright/quantities/functionals/material_volume.h"
#include "wheelwright/quantities/functionals/perimeter.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/curvature.h"

namespace wheelwright {
namespace {

using testing::generic_hole;
using testing::holes;
using testing::paper_model;
using testing::smooth_direction;

/// Two holes of different sizes, one across the sector's face: no symmetry at all.
LevelSet<2> lopsided_holes(const PolarGrid<2>& grid) {
  const double a = grid.sector_angle();
  return holes(grid, 2, {{0.2513, 0.04 * a, 0.0213}, {0.2731, 0.53 * a, 0.0267}});
}

RollingModel<2> lopsided_model() {
  auto model = paper_model(14, 192);
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed = {{3e4, 1e4}, 1e4};
  model.n_positions = 4;
  return model;
}

/// The fourth power of the von Mises stress over a yield stress of 1 MPa, integrated over the material: a
/// function whose adjoint load acts everywhere in the material. This file adds it to the program: a class
/// and, in a run, one line in the list of functionals.
class StressPower : public MaterialDensityIntegral<2> {
 public:
  std::string name() const override { return "stress_power"; }

 private:
  /// With s^2 = 6 mu^2 (e:e - (tr e)^2 / 3) in plane strain.
  Value at(const Voigt<2>& e, const MaterialLaw<2>& law) const override {
    const double mu = law.isotropic()->mu(), scale = 6 * mu * mu / 1e12, trace = e[0] + e[1];
    const double square = scale * (e[0] * e[0] + e[1] * e[1] + 0.5 * e[2] * e[2] - trace * trace / 3);
    const double slope = 2 * square * scale;
    return {square * square,
            {slope * (2 * e[0] - 2 * trace / 3), slope * (2 * e[1] - 2 * trace / 3), slope * e[2]}};
  }
};

/// Half of sigma:eps as an integral over the material: the strain energy by another way.
class EnergyDensity : public MaterialDensityIntegral<2> {
 public:
  std::string name() const override { return "energy_density"; }

 private:
  Value at(const Voigt<2>& e, const MaterialLaw<2>& law) const override {
    const Voigt<2> sigma = stress<2>(law, e);
    return {0.5 * (sigma[0] * e[0] + sigma[1] * e[1] + sigma[2] * e[2]), sigma};
  }
};

/// The square of the change of the dilatation from each load case to the next one of the turn: a function of
/// the history of a point. Load case i n_sectors + s has the ground at position i, s sectors back; the
/// positions of a sector follow each other with i.
class StrainRate : public MaterialDensityIntegral<2, DensityOfHistory<2>> {
 public:
  std::string name() const override { return "strain_rate"; }

 private:
  void densities_at(const StrainsAtPoint<2>& point, std::span<double> values) const override {
    for (int j = 0; j < point.n_cases(); ++j) values[j] = change(point, j) * change(point, j);
  }
  void slopes_at(const StrainsAtPoint<2>& point, std::span<const double> factors,
                 const StressRows<2>& slopes) const override {
    for (const auto& row : slopes) std::ranges::fill(row, 0.0);
    for (int j = 0; j < point.n_cases(); ++j)
      for (int d = 0; d < 2; ++d) {
        slopes[d][next(point, j)] += 2e6 * factors[j] * change(point, j);
        slopes[d][j] -= 2e6 * factors[j] * change(point, j);
      }
  }

  /// Near the tread strains change within a patch.
  bool covers(const PolarGrid<2>& grid, int row) const override { return row < grid.cells[0] / 2; }

  static int next(const StrainsAtPoint<2>& point, int j) {
    const int n_positions = point.n_cases() / point.n_sectors;
    const int position = j / point.n_sectors, sector = j % point.n_sectors;
    if (position + 1 < n_positions) return j + point.n_sectors;
    return (sector + point.n_sectors - 1) % point.n_sectors;
  }
  static double change(const StrainsAtPoint<2>& point, int j) {
    const int after = next(point, j);
    return 1e6 *
           (point.strains[0][after] + point.strains[1][after] - point.strains[0][j] - point.strains[1][j]);
  }
};

/// N = |x|^2 on the edges of the holes.
class EdgeMoment : public BoundaryIntegral<2> {
 public:
  std::string name() const override { return "edge_moment"; }

 private:
  Density density(const Vec<2>& x) const override { return {dot<2>(x, x), {2 * x[0], 2 * x[1]}}; }
};

Expected<Evaluation<2>> evaluation_of(const StateSolver<2>& solver,
                                      const std::vector<ShapeFunction<2>>& functions,
                                      const LevelSet<2>& psi) {
  auto evaluated = evaluate<2>(solver, functions, psi);
  if (!evaluated) return evaluated.failure();
  return std::move(evaluated->evaluation);
}

Expected<TaylorTest> taylor(const StateSolver<2>& solver, const std::vector<ShapeFunction<2>>& functions,
                            const LevelSet<2>& psi, std::string_view name) {
  return taylor_test<2>([&](const LevelSet<2>& shape) { return evaluation_of(solver, functions, shape); },
                        psi, smooth_direction(psi.lattice), solver.model().degree, 2e-5, 3, name);
}

void expect_second_order(const Expected<TaylorTest>& test, double lowest = 1.9) {
  ASSERT_TRUE(test) << test.failure().detail;
  for (const double order : test->orders) EXPECT_GT(order, lowest);
}

TEST(Functions, AStressFunctionPassesTheTaylorTest) {
  for (auto model : {paper_model(14, 192), lopsided_model()}) {
    for (const int levels : {0, 1}) {
      model.tread.levels = levels;
      const auto problem = RollingProblem<2>::create(model);
      ASSERT_TRUE(problem) << problem.failure().detail;
      const std::vector<ShapeFunction<2>> functions{{"stress", {{1, std::make_shared<StressPower>()}}}};
      expect_second_order(taylor(*problem, functions, generic_hole(model.grid), "stress"));
    }
  }
}

TEST(Functions, AFunctionOfTheHistoryOfEveryPointPassesTheTaylorTest) {
  for (const auto& model : {paper_model(14, 192), lopsided_model()}) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const std::vector<ShapeFunction<2>> functions{{"rate", {{1, std::make_shared<StrainRate>()}}}};
    expect_second_order(taylor(*problem, functions, generic_hole(model.grid), "rate"));
  }
}

// A point strains smoothly as the wheel turns: between twice as many positions it changes half as much.
TEST(Functions, TheLoadCasesOfAPointFollowEachOtherRoundTheTurn) {
  std::vector<double> values;
  for (const int n_positions : {8, 16}) {
    RollingModel<2> model = paper_model(14, 192);
    model.n_positions = n_positions;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const std::vector<ShapeFunction<2>> functions{{"rate", {{1, std::make_shared<StrainRate>()}}}};
    const auto evaluation = evaluation_of(*problem, functions, testing::paper_holes(model.grid));
    ASSERT_TRUE(evaluation);
    values.push_back(evaluation->functions[0].value * n_positions);
  }
  EXPECT_NEAR(values[1] / values[0], 1, 0.15);
}

// The tread's share of the integral is known at the grid's own nodes only, without refinement it is all of
// it. The energy of a projected dilatation belongs to a cell and is no function of the strain at a point.
TEST(Functions, TheStrainEnergyAsAnIntegralIsTheStrainEnergy) {
  for (auto model : {paper_model(14, 192), lopsided_model()}) {
    model.dilatation = DilatationKind::pointwise;
    model.ghost.xi = 1e-9;
    model.cut_points = 4;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const std::vector<ShapeFunction<2>> functions{{"integral", {{1, std::make_shared<EnergyDensity>()}}},
                                                  {"energy", {{1, std::make_shared<StrainEnergy<2>>()}}}};
    const auto evaluation = evaluation_of(*problem, functions, lopsided_holes(model.grid));
    ASSERT_TRUE(evaluation) << evaluation.failure().detail;
    const auto &integral = evaluation->functions[0], &energy = evaluation->functions[1];
    EXPECT_NEAR(integral.value, energy.value, 1e-8 * energy.value);
    EXPECT_LT(testing::relative_difference(integral.by_position, energy.by_position), 1e-8);
    EXPECT_LT(testing::relative_difference(integral.gradient, energy.gradient), 1e-5);
  }
}

// As one block of right-hand sides the adjoints are what they are one by one.
TEST(Functions, SeveralTogetherEqualEachAlone) {
  const auto model = lopsided_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const auto energy = std::make_shared<StrainEnergy<2>>();
  const auto naive = std::make_shared<UniformityL2<2>>(0.01);
  const auto stress = std::make_shared<StressPower>();
  const std::vector<ShapeFunction<2>> functions{{"energy", {{1, energy}}},
                                                {"volume", {{1, std::make_shared<MaterialVolume<2>>()}}},
                                                {"naive", {{1, naive}}},
                                                {"sum", {{2, energy}, {3, naive}, {-0.5, stress}}},
                                                {"stress", {{1, stress}}, {1, 0, -2, 0.5}}};
  const auto together = evaluation_of(*problem, functions, psi);
  ASSERT_TRUE(together) << together.failure().detail;
  EXPECT_EQ(together->terms.size(), 4);
  for (const auto& function : functions) {
    const auto alone = evaluation_of(*problem, {function}, psi);
    ASSERT_TRUE(alone);
    const FunctionValue &a = alone->function(function.name), &b = together->function(function.name);
    EXPECT_NEAR(a.value, b.value, 1e-12 * std::abs(a.value)) << function.name;
    EXPECT_LT(testing::relative_difference(b.gradient, a.gradient), 1e-9) << function.name;
  }
  const auto& g = together->functions;
  const auto unweighted = evaluation_of(*problem, {{"stress", {{1, stress}}}}, psi);
  for (size_t q = 0; q < together->boundary.size(); ++q)
    EXPECT_NEAR(g[3].gradient[q],
                2 * g[0].gradient[q] + 3 * g[2].gradient[q] - 0.5 * unweighted->functions[0].gradient[q],
                1e-8 * std::abs(g[3].gradient[q]) + 1e-6);
}

TEST(Functions, WeightsPerPositionPassTheTaylorTest) {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const std::vector<double> weights{0.3, 2, 0, -1};
  const WeightedSum<2> terms{{1, std::make_shared<StrainEnergy<2>>()},
                             {1e-3, std::make_shared<StressPower>()},
                             {10, std::make_shared<UniformityL2<2>>(0.01)}};
  expect_second_order(taylor(*problem, {{"weighted", terms, weights}}, generic_hole(model.grid), "weighted"));
}

// Each alone, where the others cannot hide it. With weights the deviations from the mean do not sum to zero
// over the positions, so that the mean's own derivative counts: little, which only small steps show.
TEST(Functions, TheGradientsOfWeightedTermsAreThoseOfDifferences) {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = generic_hole(model.grid);
  const auto direction = smooth_direction(psi.lattice);
  const std::vector<double> weights{0.3, 2, 0, -1};
  const std::vector<ShapeFunction<2>> functions{
      {"naive", {{1, std::make_shared<UniformityL2<2>>(0.01)}}, weights},
      {"stress", {{1, std::make_shared<StressPower>()}}, weights}};
  const auto at = [&](double t) {
    auto moved = psi;
    for (size_t i = 0; i < direction.size(); ++i) moved.values[i] += t * direction[i];
    return *evaluation_of(*problem, functions, moved);
  };
  const double t = 1e-6;
  const auto before = at(-t), here = at(0), after = at(t);
  for (const auto& function : functions) {
    const double difference =
        (after.function(function.name).value - before.function(function.name).value) / (2 * t);
    const double derivative = directional_derivative<2>(here.gradient(function.name), psi, direction, 2);
    EXPECT_NEAR(derivative / difference, 1, 2e-5) << function.name;  // the error of the material's quadrature
  }
}

// The value is the weighted sum over all positions of the sector, images included; weights that differ
// between mirror images need all positions.
TEST(Functions, WeightsPerPositionAreFactorsOfTheirPositions) {
  auto model = paper_model(14, 192);
  model.n_positions = 5;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = holes(model.grid, 2, {{0.2681, 0.5 * model.grid.sector_angle(), 0.0373}});
  const WeightedSum<2> energy{{2, std::make_shared<StrainEnergy<2>>()}};
  const auto plain = evaluation_of(*problem, {{"energy", energy}}, psi);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->newton_iterations.size(), 3);
  const auto& by_position = plain->functions[0].by_position;
  ASSERT_EQ(by_position.size(), 5);
  const std::vector<double> even{1, 0.5, 3, 3, 0.5}, uneven{1, 0.5, 3, 2, 0.5};
  for (const auto& [weights, n_solved] : {std::pair{even, 3}, {uneven, 5}}) {
    const auto weighted = evaluation_of(*problem, {{"energy", energy, weights}}, psi);
    ASSERT_TRUE(weighted);
    EXPECT_EQ(weighted->newton_iterations.size(), n_solved);
    double sum = 0;
    for (int i = 0; i < 5; ++i) sum += weights[i] * by_position[i];
    EXPECT_NEAR(weighted->functions[0].value, sum, 1e-8 * sum);
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(weighted->functions[0].by_position[i], weights[i] * by_position[i], 1e-8 * sum);
  }
}

TEST(Functions, WeightOnOnePositionIsOnlyThatPosition) {
  const auto model = lopsided_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const WeightedSum<2> energy{{1, std::make_shared<StrainEnergy<2>>()}};
  std::vector<ShapeFunction<2>> functions{{"all", energy}};
  for (int i = 0; i < model.n_positions; ++i) {
    functions.push_back({std::to_string(i), energy, std::vector<double>(model.n_positions, 0.0)});
    functions.back().position_weights[i] = 1;
  }
  const auto e = evaluation_of(*problem, functions, psi);
  ASSERT_TRUE(e) << e.failure().detail;
  for (size_t q = 0; q < e->boundary.size(); ++q) {
    double sum = 0, size = 0;
    for (int i = 1; i <= model.n_positions; ++i) {
      sum += e->functions[i].gradient[q];
      size += std::abs(e->functions[i].gradient[q]);
    }
    EXPECT_NEAR(e->functions[0].gradient[q], sum, 1e-8 * size);
  }
}

TEST(Functions, BoundsArePassedOn) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto e = evaluation_of(
      *problem,
      {{.name = "volume", .terms = {{1, std::make_shared<MaterialVolume<2>>()}}, .bounds = {0.1, 0.2}}},
      generic_hole(model.grid));
  ASSERT_TRUE(e);
  EXPECT_EQ(e->functions[0].bounds.lower, 0.1);
  EXPECT_EQ(e->functions[0].bounds.upper, 0.2);
}

// --- Functions of the shape alone ----------------------------------------------------------------------

TEST(ShapeFunctions, TheVolumeIsThatOfTheMaterialAndItsGradientIsOne) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const std::vector<ShapeFunction<2>> functions{{"volume", {{1, std::make_shared<MaterialVolume<2>>()}}}};
  const auto e = evaluation_of(*problem, functions, psi);
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->functions[0].value, material_measure(psi), 1e-12 * e->functions[0].value);
  for (const double g : e->functions[0].gradient) EXPECT_EQ(g, 1);
  EXPECT_TRUE(e->functions[0].by_position.empty());
  expect_second_order(taylor(*problem, functions, generic_hole(model.grid), "volume"));
}

// kappa = -1/r on the edge of a hole of radius r, with an error of order h for a quadratic level set.
TEST(ShapeFunctions, TheCurvatureOfACircleIsOneOverItsRadius) {
  std::vector<double> errors;
  for (const int refinement : {1, 2, 4}) {
    const PolarGrid<2> grid = paper_model(14 * refinement, 192 * refinement).grid;
    const auto psi = lopsided_holes(grid);
    double worst = 0;
    for (const auto& sample : boundary_samples(psi)) {
      const double curvature = mean_curvature<2>(psi, 2, sample.cell, sample.xi);
      worst = std::max(worst, std::min(std::abs(0.0213 * curvature + 1), std::abs(0.0267 * curvature + 1)));
    }
    errors.push_back(worst);
  }
  EXPECT_LT(errors[2], 0.1);
  for (int k = 1; k < 3; ++k) EXPECT_GT(std::log2(errors[k - 1] / errors[k]), 0.9);
}

// The derivative leaves out the kinks of the discrete boundary on the faces of cells: it tends to the
// difference quotient with the grid. The perimeter of the holes is exact to O(h^3).
TEST(ShapeFunctions, PerimeterAndEdgeIntegralsTendToTheirDerivatives) {
  const auto perimeter = std::make_shared<Perimeter<2>>();
  const auto moment = std::make_shared<EdgeMoment>();
  std::vector<double> lengths, errors, of_moment;
  for (const int refinement : {1, 2, 4}) {
    auto model = paper_model(14 * refinement, 192 * refinement);
    model.n_positions = 1;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto psi = lopsided_holes(model.grid);
    const std::vector<ShapeFunction<2>> functions{{"perimeter", {{1, perimeter}}}, {"moment", {{1, moment}}}};
    const auto e = evaluation_of(*problem, functions, psi);
    ASSERT_TRUE(e);
    const double exact = 2 * std::numbers::pi * (0.0213 + 0.0267);
    lengths.push_back(std::abs(e->function("perimeter").value / exact - 1));
    const auto direction = smooth_direction(psi.lattice);
    const auto at = [&](double t, std::string_view name) {
      auto moved = psi;
      for (size_t i = 0; i < direction.size(); ++i) moved.values[i] += t * direction[i];
      return evaluation_of(*problem, functions, moved)->function(name).value;
    };
    const double t = 1e-6;
    for (const auto& [name, list] : {std::pair{"perimeter", &errors}, {"moment", &of_moment}}) {
      const double difference = (at(t, name) - at(-t, name)) / (2 * t),
                   derivative = directional_derivative<2>(e->gradient(name), psi, direction, 2);
      double scale = 0;
      for (const auto& sample : e->gradient(name)) scale += sample.weight * std::abs(sample.value);
      list->push_back(std::abs(derivative - difference) / scale);
    }
  }
  for (const auto& list : {lengths, errors, of_moment}) {
    EXPECT_LT(list[2], 1e-3);
    EXPECT_GT(std::log2(list[0] / list[2]) / 2, 1.5);
  }
}

}  // namespace
}  // namespace wheelwright
