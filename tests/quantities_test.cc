#include "wheelwright/quantities/functionals/quantities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/mechanics/elasticity/isotropic_law.h"
#include "wheelwright/mechanics/elasticity/von_mises.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/quantities/functionals/largest_strain.h"
#include "wheelwright/quantities/functionals/mass.h"
#include "wheelwright/quantities/functionals/over_positions.h"
#include "wheelwright/quantities/functionals/peak_pressure.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/quotient.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"

namespace wheelwright {
namespace {

using testing::generic_hole;
using testing::holes;
using testing::paper_model;
using testing::smooth_direction;
using Pointer = std::shared_ptr<const Functional<2>>;

/// Two holes of different sizes, one across the sector's face: no symmetry at all.
LevelSet<2> lopsided_holes(const PolarGrid<2>& grid) {
  const double a = grid.sector_angle();
  return holes(grid, 2, {{0.2513, 0.04 * a, 0.0213}, {0.2731, 0.53 * a, 0.0267}});
}

RollingModel<2> coarse_model() {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  model.cut_points = 6;  // the derivative of an integral over cut cells is exact up to their quadrature
  return model;
}

/// With friction; the rim is driven, pushed along the ground and free in all its ways.
RollingModel<2> driven_model() {
  auto model = coarse_model();
  model.contact.friction = 0.4;
  model.torque = 60;
  model.horizontal_force = 300;
  model.distributed = {{3e4, 1e4}, 1e4};
  return model;
}

RollingModel<2> held_model() {
  auto model = coarse_model();
  model.travel = 1e-3;
  return model;
}

Pointer travel(RimWay way = RimWay::towards_ground) { return std::make_shared<RimTravel<2>>(way); }
Pointer force(RimWay way = RimWay::towards_ground) { return std::make_shared<GroundForce<2>>(way); }

/// Every functional of the states that a quantity is made of, and functions of all positions. Peaks as
/// p-norms: their correction is held within one shape.
std::vector<ShapeFunction<2>> state_functions() {
  const PeakNorm norm{.exponent = 8, .correction = 1.5};
  const Pointer pressure = std::make_shared<PeakPressure<2>>(norm);
  const Pointer stress = std::make_shared<PeakVonMises<2>>(0.025, norm);
  const Pointer stiffness = std::make_shared<Quotient<2>>("stiffness", force(), travel());
  const auto over = [](const char* name, const Pointer& functional,
                       FunctionOfPositions<2>::Function function) {
    return ShapeFunction<2>{
        name, {{1, std::make_shared<FunctionOfPositions<2>>(name, functional, std::move(function))}}};
  };
  const auto harmonic = [](std::span<const double> x) { return harmonic_amplitude(x, 1); };
  const auto maximum = [](double sharpness) {
    return [sharpness](std::span<const double> x) { return smooth_maximum(x, sharpness); };
  };
  return {{"travel", {{1, travel()}}},
          {"force", {{1, force()}}},
          {"stiffness", {{1, stiffness}}},
          {"pressure", {{1, pressure}}},
          {"stress", {{1, stress}}},
          {"strain", {{1, std::make_shared<LargestStrain<2>>(norm)}}},
          {"one position", {{1, travel()}}, {0, 1, 0, 0}},
          {"mean stiffness", {{1, std::make_shared<RatioOfMeans<2>>("mean stiffness", force(), travel())}}},
          over("run-out harmonic", travel(), harmonic),
          over("force harmonic", force(), harmonic),
          over("softest", stiffness, maximum(-1e-6)),
          over("worst pressure", pressure, maximum(1e-6)),
          over("worst evenness", std::make_shared<UniformityL2<2>>(0.01), maximum(10))};
}

Expected<Evaluation<2>> evaluation_of(const StateSolver<2>& solver,
                                      const std::vector<ShapeFunction<2>>& functions,
                                      const LevelSet<2>& psi) {
  auto evaluated = evaluate<2>(solver, functions, psi);
  if (!evaluated) return evaluated.failure();
  return std::move(evaluated->evaluation);
}

/// The Taylor tests of several functions at once, along a direction without symmetry. Remainders at the level
/// of rounding have no order.
void expect_second_order(const RollingModel<2>& model, const std::vector<ShapeFunction<2>>& functions,
                         const LevelSet<2>& psi, double step = 2e-5) {
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  std::map<double, Evaluation<2>> evaluations;  // by the level set's first value
  const auto evaluate = [&](const LevelSet<2>& shape) -> Expected<Evaluation<2>> {
    const auto known = evaluations.find(shape.values[0]);
    if (known != evaluations.end()) return known->second;
    auto evaluation = evaluation_of(*problem, functions, shape);
    if (evaluation) evaluations.emplace(shape.values[0], *evaluation);
    return evaluation;
  };
  for (const auto& function : functions) {
    const auto test =
        taylor_test<2>(evaluate, psi, smooth_direction(psi.lattice), model.degree, step, 3, function.name);
    ASSERT_TRUE(test) << test.failure().detail;
    for (size_t k = 0; k < test->orders.size(); ++k)
      if (test->remainders[k + 1] > 1e-10 * std::abs(test->value)) {
        EXPECT_GT(test->orders[k], 1.9) << function.name << ", step " << k;
      }
    EXPECT_GT(std::abs(test->derivative) * step, 20 * test->remainders.front()) << function.name;
  }
}

std::vector<ShapeFunction<2>> without(std::vector<ShapeFunction<2>> functions,
                                      const std::vector<std::string>& names) {
  std::erase_if(functions, [&](const auto& f) { return std::ranges::find(names, f.name) != names.end(); });
  return functions;
}

TEST(Quantities, PassTheTaylorTest) {
  const auto model = coarse_model();
  // At a held load the force has no derivative.
  const auto functions = without(state_functions(), {"force", "force harmonic"});
  expect_second_order(model, functions, generic_hole(model.grid));
}

TEST(Quantities, PassTheTaylorTestAtFixedTravel) {
  const auto model = held_model();
  const auto functions = without(state_functions(), {"travel", "run-out harmonic", "one position"});
  expect_second_order(model, functions, generic_hole(model.grid), 1e-5);
}

TEST(Quantities, PassTheTaylorTestWithFrictionAndADrivenRim) {
  const auto model = driven_model();
  auto functions = without(state_functions(), {"force harmonic"});
  for (const RimWay way : {RimWay::along_ground, RimWay::rotation}) {
    const Pointer stiffness = std::make_shared<Quotient<2>>("stiffness", force(way), travel(way));
    functions.push_back({"stiffness of " + travel(way)->name(), {{1, stiffness}}});
    functions.push_back({travel(way)->name(), {{1, travel(way)}}, {0.3, 1, -2, 0}});
  }
  expect_second_order(model, functions, generic_hole(model.grid));
}

/// Functions of all positions whose smoothness is not adapted to the values.
TEST(Quantities, FunctionsOfAllPositionsHaveTheSlopesOfTheirDifferences) {
  const std::vector<double> values{1.3, 0.7, 2.1, 1.9, 0.4, 1.1, 1.75};
  const std::vector<FunctionOfPositions<2>::Function> functions{
      mean_of, [](auto x) { return smooth_maximum(x, 3); }, [](auto x) { return smooth_maximum(x, -5); },
      [](auto x) { return harmonic_amplitude(x, 1); }, [](auto x) { return harmonic_amplitude(x, 3); }};
  for (const auto& function : functions) {
    const auto at = function(values);
    for (size_t i = 0; i < values.size(); ++i) {
      auto more = values, less = values;
      more[i] += 1e-5;
      less[i] -= 1e-5;
      EXPECT_NEAR(at.slopes[i], (function(more).value - function(less).value) / 2e-5, 1e-9);
    }
    const std::vector<double> reversed(values.rbegin(), values.rend());
    EXPECT_NEAR(function(reversed).value, at.value, 1e-14);
  }
}

TEST(Quantities, ExtremesAreTrueOnesAndTheirSlopesSumToOne) {
  const std::vector<double> values{1.3, 0.7, 2.1, 1.9}, equal(4, 1.5);
  EXPECT_EQ(maximum_of(values).value, 2.1);
  EXPECT_EQ(minimum_of(values).value, 0.7);
  EXPECT_DOUBLE_EQ(peak_to_peak_of(values).value, 1.4);
  EXPECT_EQ(peak_to_peak_of(equal).value, 0);
  for (const auto& x : {values, equal}) {
    const auto maximum = maximum_of(x), minimum = minimum_of(x);
    double up = 0, down = 0;
    for (size_t i = 0; i < x.size(); ++i) {
      up += maximum.slopes[i];
      down += minimum.slopes[i];
      EXPECT_NEAR(maximum.slopes[i] - minimum.slopes[i], peak_to_peak_of(x).slopes[i], 1e-15);
    }
    EXPECT_NEAR(up, 1, 1e-14);
    EXPECT_NEAR(down, 1, 1e-14);
  }
  // The extreme itself counts most.
  const auto slopes = maximum_of(values).slopes;
  EXPECT_EQ(std::ranges::max_element(slopes) - slopes.begin(), 2);
  EXPECT_GT(minimum_of(values).slopes[1], 0.9);
  // Scale and offset change neither slopes nor meaning.
  std::vector<double> scaled;
  for (const double x : values) scaled.push_back(1e-3 * x - 7);
  for (size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(maximum_of(scaled).slopes[i], maximum_of(values).slopes[i], 1e-9);
}

/// A cosine's amplitude is found at its harmonic and nowhere else; a constant has none, and no slopes.
TEST(Quantities, AHarmonicIsTheAmplitudeOfACosine) {
  std::vector<double> values;
  for (int j = 0; j < 9; ++j) values.push_back(3 + 0.25 * std::cos(2 * std::numbers::pi * (2 * j + 0.7) / 9));
  EXPECT_NEAR(harmonic_amplitude(values, 2).value, 0.25, 1e-14);
  EXPECT_NEAR(harmonic_amplitude(values, 1).value, 0, 1e-14);
  const auto variation = rolling_variation(values);
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(harmonic_amplitude(values, k).value, variation.harmonics[k - 1], 1e-14);
  const auto flat = harmonic_amplitude(std::vector<double>(8, 2.0), 1);
  EXPECT_EQ(flat.value, 0);
  EXPECT_EQ(flat.slopes, std::vector<double>(8, 0.0));
}

double total(const FunctionalValue<2>& value, const LoadPositions& positions) {
  double sum = 0;
  for (int i = 0; i < positions.size(); ++i) sum += positions.multiplicities[i] * value.by_position[i];
  return sum;
}

/// Every quantity is the number that analyses tell.
TEST(Quantities, AreTheNumbersOfTheAnalysis) {
  for (const auto& model : {coarse_model(), driven_model(), held_model()}) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto psi = lopsided_holes(model.grid);
    const auto state = testing::all_states<2>(*problem, psi);
    ASSERT_TRUE(state) << state.failure().detail;
    const auto summary = shape_summary<2>(*problem, **state);
    const auto contacts = contact_summaries<2>(**state);
    const auto& peaks = (*state)->strain_peaks();
    const auto value = [&](std::string_view quantity, Over over) {
      const auto result = functional_of<2>(built_in(quantity), over, {*problem})
                              ->functional->evaluate(*problem, psi, **state, {});
      return result.over_positions ? *result.over_positions : result.by_position.at(2);
    };
    const auto relative = [](double a, double b) { return std::abs(a - b) / std::abs(b); };
    EXPECT_LT(relative(value("mean_travel", Over::mean), summary.rolling.mean_travel), 1e-12);
    EXPECT_LT(relative(value("stiffness", Over::mean), summary.stiffness), 1e-12);
    EXPECT_LT(relative(value("peak_pressure", Over::maximum), summary.rolling.peak_pressure), 1e-12);
    if (!model.travel) {
      EXPECT_LT(relative(value("run_out", Over::mean), summary.rolling.run_out), 1e-12);
    }
    EXPECT_LT(relative(value("strain_energy", Over::mean), summary.strain_energy), 1e-12);
    EXPECT_LT(relative(value("travel", Over::positions), contacts[2].travel), 1e-12);
    EXPECT_LT(relative(value("radial_force", Over::positions), contacts[2].radial_force), 1e-12);
    EXPECT_LT(relative(value("peak_pressure", Over::positions), contacts[2].peak_pressure), 1e-12);
    // The points of the two quadratures differ.
    EXPECT_LT(relative(value("peak_von_mises", Over::positions), peaks.von_mises[2]), 0.05);
    EXPECT_LE(value("peak_von_mises_inside", Over::maximum),
              (1 + 1e-12) * value("peak_von_mises", Over::maximum));
    if (model.torque != 0) {
      EXPECT_LT(relative(value("tangential_stiffness", Over::positions),
                         -contacts[2].friction_force / contacts[2].travel_along_ground),
                1e-12);
      EXPECT_LT(relative(force(RimWay::rotation)->evaluate(*problem, psi, **state, {}).by_position[2] /
                             (*state)->contacts()[2].rim.rotation,
                         value("torsional_stiffness", Over::positions)),
                1e-12);
    }
  }
}

/// Without loads on the structure itself the ground takes what the rim is loaded with.
TEST(Quantities, TheGroundTakesTheLoadsOfTheRim) {
  auto model = driven_model();
  model.distributed = {};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state) << state.failure().detail;
  const auto by_position = [&](RimWay way) {
    return force(way)->evaluate(*problem, psi, **state, {}).by_position;
  };
  for (int i = 0; i < model.n_positions; ++i) {
    EXPECT_NEAR(by_position(RimWay::towards_ground)[i], model.load, 1e-9 * model.load);
    EXPECT_NEAR(by_position(RimWay::along_ground)[i], model.horizontal_force, 1e-9 * model.load);
    EXPECT_NEAR(by_position(RimWay::rotation)[i], model.torque, 1e-9 * model.load);
  }
}

/// With the positions that mirror images stand for, values and gradients are those of all positions.
TEST(Quantities, SymmetricWheelNeedsHalfOfThePositions) {
  auto model = coarse_model();
  model.n_positions = 6;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  auto functions = without(state_functions(), {"one position", "force", "force harmonic"});
  const auto with_images = evaluation_of(*problem, functions, psi);
  // A weight that is not its own mirror image makes all positions be solved.
  functions.push_back({"all", {{1, travel()}}, {1, 2, 3, 4, 5, 6}});
  const auto all = evaluation_of(*problem, functions, psi);
  ASSERT_TRUE(with_images && all);
  ASSERT_GT(all->newton_iterations.size(), with_images->newton_iterations.size());
  const auto direction = smooth_direction(psi.lattice);
  for (const auto& f : with_images->functions) {
    const auto& g = all->function(f.name);
    EXPECT_NEAR(f.value, g.value, 1e-6 * std::abs(g.value)) << f.name;
    const double a = directional_derivative<2>(with_images->gradient(f.name), psi, direction, model.degree),
                 b = directional_derivative<2>(all->gradient(f.name), psi, direction, model.degree);
    EXPECT_NEAR(a, b, 1e-5 * std::abs(b) + 1e-9 * std::abs(g.value)) << f.name;
  }
}

/// By the envelope of the energy: J_e - P alpha is stationary in the states, so that without friction its
/// derivative to the shape needs no adjoint; J_e and alpha have their own.
TEST(Quantities, TheTravelsDerivativeFollowsFromTheEnergys) {
  auto model = coarse_model();
  model.dilatation = DilatationKind::pointwise;
  model.contact.theta_nitsche = 1;
  model.contact.gamma_0 = 1e5;
  model.ghost.xi = 1e-9;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const std::vector<ShapeFunction<2>> functions{
      {"potential", {{1, std::make_shared<StrainEnergy<2>>()}, {-model.load, travel()}}},
      {"energy", {{1, std::make_shared<StrainEnergy<2>>()}}}};
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  const auto evaluation = differentiate<2>(*problem, functions, psi, **state);
  ASSERT_TRUE(evaluation);
  // The density of the energy at the moving boundary, which is a function of the strain where the dilatation
  // is not projected. Slivers, which the ghost penalty hardly holds here, differ.
  double sum = 0, error = 0;
  for (size_t q = 0; q < evaluation->boundary.size(); ++q) {
    double density = 0;
    const auto& point = evaluation->boundary[q];
    const Displacement<2>& displacement = (*state)->displacement();
    const Matrix strains = displacement.strains(point.cell, std::span(&point.xi, 1)).by_rows();
    for (int j = 0; j < strains.columns(); ++j) {
      const Voigt<2> e{strains(0, j), strains(1, j), strains(2, j)};
      const Voigt<2> sigma = stress<2>(model.materials.at_tread(), e);
      density += 0.5 * (sigma[0] * e[0] + sigma[1] * e[1] + sigma[2] * e[2]);
    }
    const double potential = evaluation->function("potential").gradient[q];
    sum += point.weight * density;
    error += point.weight * std::abs(potential - density);
  }
  EXPECT_LT(error, 1e-3 * sum);
}

TEST(Quantities, TheMassIsThatOfTheMaterial) {
  const Material dense{200e6, 0.48, Plane::strain, 1150};
  const auto model = coarse_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = holes(model.grid, 2, {{0.27, 0.5 * model.grid.sector_angle(), 0.04}});
  const auto evaluation = evaluation_of(*problem, {{"mass", {{1, std::make_shared<Mass<2>>(dense)}}}}, psi);
  ASSERT_TRUE(evaluation);
  const double area = std::numbers::pi * (0.34 * 0.34 - 0.2 * 0.2 - 16 * 0.04 * 0.04);
  EXPECT_NEAR(evaluation->function("mass").value, 1150 * area, 1e-4 * 1150 * area);
  expect_second_order(model, {{"mass", {{1, std::make_shared<Mass<2>>(dense)}}}}, generic_hole(model.grid));
}

/// The p-norm of a higher power is nearer to the peak, from below for norms by the mean; corrected it is the
/// peak, and its gradient is that of the norm.
TEST(Quantities, PeaksAreCorrectedNorms) {
  const auto model = coarse_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  for (const int exponent : {8, 16, 32}) {
    const PeakNorm corrected{.exponent = exponent}, plain{.exponent = exponent, .correction = 1};
    const std::vector<std::pair<Pointer, Pointer>> pairs{
        {std::make_shared<PeakPressure<2>>(corrected), std::make_shared<PeakPressure<2>>(plain)},
        {std::make_shared<PeakVonMises<2>>(0.025, corrected),
         std::make_shared<PeakVonMises<2>>(0.025, plain)},
        {std::make_shared<LargestStrain<2>>(corrected), std::make_shared<LargestStrain<2>>(plain)}};
    for (const auto& [peak, norm] : pairs) {
      const auto a = peak->evaluate(*problem, psi, **state, {}),
                 b = norm->evaluate(*problem, psi, **state, {});
      const auto evaluation = evaluation_of(
          *problem, {{"peak", {{1, peak}}, {1, 0, 0, 0}}, {"norm", {{1, norm}}, {1, 0, 0, 0}}}, psi);
      ASSERT_TRUE(evaluation);
      const double correction = a.by_position[0] / b.by_position[0];
      const auto &g = evaluation->functions[0].gradient, &h = evaluation->functions[1].gradient;
      for (size_t q = 0; q < g.size(); ++q)
        EXPECT_NEAR(g[q], correction * h[q], 1e-9 * std::abs(g[q]) + 1e-9 * std::abs(a.by_position[0]));
      EXPECT_GT(total(a, (*state)->positions()), 0);
    }
  }
}

/// The largest strain is the largest principal one at the points of the quadrature, also along the axle.
TEST(Quantities, TheLargestStrainIsThatOfAPoint) {
  auto model = coarse_model();
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    model.materials = Material{200e6, 0.45, plane};
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto psi = lopsided_holes(model.grid);
    const auto state = testing::all_states<2>(*problem, psi);
    ASSERT_TRUE(state);
    std::vector<double> expected((*state)->positions().size(), 0.0);
    for_each_cell<2>(*problem, **state, StrainPower<2>(2), [&](const StrainedCell<2>& cell) {
      for (int q = 0; q < cell.n_points(); ++q) {
        const StrainsAtPoint<2> point = cell.at(q);
        std::vector<double> stresses(cell.n_cases()), axial(cell.n_cases());
        point.law.along_axle(point.strains, stresses, axial);
        for (int j = 0; j < cell.n_cases(); ++j) {
          const double a = point.strains[0][j], b = point.strains[1][j], c = point.strains[2][j];
          const double in_plane = std::abs(a + b) / 2 + std::hypot(a - b, c) / 2;
          double& largest = expected[j / cell.n_sectors()];
          largest = std::max({largest, in_plane, std::abs(axial[j])});
        }
      }
    });
    const auto value = LargestStrain<2>().evaluate(*problem, psi, **state, {});
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(value.by_position[i] / expected[i], 1, 1e-10);
  }
}

template <int dim>
void expect_slopes_of_strain_power(const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
  const StrainPower<dim> power(6);
  const auto at = [&](const Voigt<dim>& e) {
    double value;
    power.densities_at({one_strain<dim>(e), 1, law, {}, {}}, {&value, 1});
    return value;
  };
  Voigt<dim> slopes;
  constexpr double factor = 2.5, step = 1e-5;
  power.slopes_at({one_strain<dim>(strain), 1, law, {}, {}}, {&factor, 1}, one_stress<dim>(slopes));
  for (int k = 0; k < n_strains<dim>; ++k) {
    Voigt<dim> more = strain, less = strain;
    more[k] += step;
    less[k] -= step;
    EXPECT_NEAR(slopes[k], factor * (at(more) - at(less)) / (2 * step),
                1e-6 * factor * std::abs(at(strain)) / 0.1);
  }
}

TEST(Quantities, StrainPowersHaveTheSlopesOfTheirDifferences) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const Material material{8e6, 0.48, plane};
    expect_slopes_of_strain_power<2>(IsotropicLaw<2>(material), {-0.11, -0.07, 0.05});
    expect_slopes_of_strain_power<2>(HyperelasticLaw<2>(material), {-0.11, -0.07, 0.05});
    expect_slopes_of_strain_power<2>(HyperelasticLaw<2>(material), {0.09, -0.09, 0});  // pure shear
  }
  expect_slopes_of_strain_power<3>(IsotropicLaw<3>(Material{8e6, 0.48}),
                                   {0.11, -0.07, 0.02, 0.05, -0.03, 0.04});
}

/// The von Mises stress of pure shear is sqrt(3) times the shear stress, of uniaxial strain 2 mu e, and the
/// squared deviator's slopes are those of its differences, in plane strain and plane stress.
TEST(Quantities, TheDeviatorIsThatOfTheStrain) {
  const Material sheet{200e6, 0.3, Plane::stress}, wide{200e6, 0.3};
  for (const Material& material : {sheet, wide}) {
    const double axial = material.axial_strain_ratio();
    const std::array<double, 3> shear{0, 0, 0.01}, any{0.013, -0.004, 0.021};
    EXPECT_NEAR(material.mu() * std::sqrt(6 * SquaredDeviator<2>(shear.data(), axial).value),
                std::sqrt(3) * material.mu() * 0.01, 1e-6);
    const auto slopes = SquaredDeviator<2>(any.data(), axial).by_strain();
    for (int k = 0; k < 3; ++k) {
      auto more = any, less = any;
      more[k] += 1e-6;
      less[k] -= 1e-6;
      EXPECT_NEAR(
          slopes[k],
          (SquaredDeviator<2>(more.data(), axial).value - SquaredDeviator<2>(less.data(), axial).value) /
              2e-6,
          1e-9);
    }
  }
  // Uniaxial stress in the sheet is its own von Mises stress.
  const std::array<double, 3> pulled{0.01, -0.3 * 0.01, 0};
  EXPECT_NEAR(sheet.mu() * std::sqrt(6 * SquaredDeviator<2>(pulled.data(), sheet.axial_strain_ratio()).value),
              200e6 * 0.01, 1e-3);
}

}  // namespace
}  // namespace wheelwright
