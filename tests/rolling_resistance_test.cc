// The force that the losses of the material cost: formulas against histories in time, exact numbers,
// derivatives.

#include "wheelwright/quantities/functionals/rolling_resistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/mechanics/state/turn_harmonics.h"
#include "wheelwright/mechanics/state/turn_losses.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/quantities/analysis/rolling_losses.h"
#include "wheelwright/quantities/functionals/quantities.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::generic_hole;
using testing::paper_model;

/// Two holes of different sizes, one across the sector's face: no symmetry at all.
LevelSet<2> lopsided_holes(const PolarGrid<2>& grid) {
  const double a = grid.sector_angle();
  return testing::holes(grid, 2, {{0.2513, 0.04 * a, 0.0213}, {0.2731, 0.53 * a, 0.0267}});
}

Material lossy(double loss_factor, Plane plane = Plane::strain, double nu = 0.3) {
  return {200e6, nu, plane, 1200, loss_factor};
}

RollingModel<2> small_model() {
  auto model = paper_model(14, 192);
  model.materials = lossy(0.2);
  model.n_positions = 4;
  model.cut_points = 6;  // the derivative of an integral over cut cells is exact up to their quadrature
  return model;
}

/// Without any symmetry, driven, with friction and loads on the structure.
RollingModel<2> lopsided_model() {
  auto model = small_model();
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed = {{3e4, 1e4}, 1e4};
  return model;
}

/// A stiff inside, a lossy tyre and a layer without losses between them.
RollingModel<2> layered_model() {
  auto model = small_model();
  using Layer = Materials<2>::Layer;
  const auto layer = [](double radius, double loss_factor, double modulus) {
    Material material = lossy(loss_factor);
    material.youngs_modulus = modulus;
    return Layer{radius, std::make_shared<IsotropicLaw<2>>(material), ""};
  };
  model.materials = Materials<2>({layer(0.23, 0.05, 400e6), layer(0.28, 0, 300e6), layer(0.34, 0.2, 200e6)});
  return model;
}

/// The inner and the middle layer, and what is outside of them.
PartOfRing inside() { return {"inside", 0.2, 0.28}; }
PartOfRing outside() { return {"outside", 0.28, 0.34}; }

double total(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

std::shared_ptr<const State<2>> solved(const RollingProblem<2>& problem, const LevelSet<2>& psi) {
  const auto state = testing::all_states<2>(problem, psi);
  if (!state) throw std::runtime_error(state.failure().detail);
  return *state;
}

double resistance(const RollingProblem<2>& problem, const LevelSet<2>& psi,
                  const std::optional<PartOfRing>& part = {}) {
  return *RollingResistance<2>(problem.model(), part)
              .evaluate(problem, psi, *solved(problem, psi), {})
              .over_positions;
}

ShapeFunction<2> function(std::string name, const RollingModel<2>& model,
                          const std::optional<PartOfRing>& part = {}) {
  return {std::move(name), {{1, std::make_shared<RollingResistance<2>>(model, part)}}};
}

WeightedFunctional<2> coefficient(const StateSolver<2>& solver) {
  return *functional_of<2>(built_in("rolling_resistance_coefficient"), Over::mean, {solver});
}

// With a factor of its own for every load case.
TEST(LossDensity, HasTheSlopesOfItsDifferences) {
  auto model = small_model();
  model.materials = lossy(0.2, Plane::stress);
  const LossDensity<2> density(model, 0, 0.2);
  const int n = model.n_positions * model.grid.n_sectors;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Matrix strains(n, 3), direction(n, 3);
  for (Matrix* each : {&strains, &direction})
    for (double& entry : each->entries()) entry = normal(random);
  std::vector<double> factors(n);
  for (double& factor : factors) factor = normal(random);
  const MaterialLaw<2>& law = *model.materials.layers().front().law;
  const auto at = [&](double h) {
    Matrix moved = strains;
    for (std::size_t k = 0; k < moved.entries().size(); ++k) moved.data()[k] += h * direction.data()[k];
    const Matrix values = density.densities({{transposed(moved)}, model.grid.n_sectors, law, {}, {Vec<2>{}}});
    return std::inner_product(factors.begin(), factors.end(), values.entries().begin(), 0.0);
  };
  const Matrix slopes =
      density.slopes({{transposed(strains)}, model.grid.n_sectors, law, {}, {Vec<2>{}}}, factors);
  const double slope =
      std::inner_product(slopes.entries().begin(), slopes.entries().end(), direction.entries().begin(), 0.0);
  // The density is quadratic: its central difference is exact.
  EXPECT_NEAR((at(1) - at(-1)) / 2, slope, 1e-10 * std::abs(slope));
}

// Of the load cases in their own order, a wave of a harmonic has no other harmonics.
TEST(TurnHarmonics, FindTheHarmonicsOfTheTurn) {
  for (const auto& [n_positions, n_sectors] : {std::pair{4, 5}, {3, 5}, {1, 7}, {6, 1}}) {
    const TurnHarmonics turn(n_positions, n_sectors);
    const int n = turn.n_cases();
    const Matrix waves = turn.waves(), unit = product(waves, Op::transpose, waves, Op::none);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) EXPECT_NEAR(unit(i, j), i == j, 1e-13);
    for (int k = 0; k < turn.n_harmonics(); ++k) {
      Matrix history(n, 1);
      for (int i = 0; i < n_positions; ++i)
        for (int s = 0; s < n_sectors; ++s) {
          const double turned = (i / double(n_positions) - s) * 2 * pi / n_sectors;  // of the ground
          history(i * n_sectors + s, 0) = std::cos(k * turned + 0.7);
        }
      const Matrix amplitudes = product(waves, Op::transpose, history, Op::none);
      for (int wave = 0; wave < n; ++wave)
        if (TurnHarmonics::harmonic(wave) != k) {
          EXPECT_NEAR(amplitudes(wave, 0), 0, 1e-12);
        }
      std::vector<double> factors;
      for (int h = 0; h < turn.n_harmonics(); ++h) factors.push_back(1 + h * h);
      const Matrix filtered = product(turn.filter(factors), Op::none, history, Op::none);
      for (int j = 0; j < n; ++j) EXPECT_NEAR(filtered(j, 0), (1 + k * k) * history(j, 0), 1e-10);
    }
  }
}

/// The work of the stress in a turn on a prescribed strain, for a material with relaxation times: the stress
/// of every branch follows its equation s' + s / tau = E e' exactly where the strain is linear in time.
double lost_in_time(const std::vector<double>& strains, double period,
                    const std::vector<std::pair<double, double>>& branches) {
  const auto n = strains.size();
  const double step = period / static_cast<double>(n);
  constexpr int n_turns = 40;  // after which the start is forgotten
  double work = 0;
  for (const auto& [modulus, time] : branches) {
    const double decay = std::exp(-step / time);
    double stress = 0, of_turn = 0;
    for (int turn = 0; turn < n_turns; ++turn) {
      of_turn = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double change = strains[(i + 1) % n] - strains[i], steady = modulus * time * change / step;
        of_turn += change * (steady + (stress - steady) * time / step * (1 - decay));  // by the mean stress
        stress = steady + (stress - steady) * decay;
      }
    }
    work += of_turn;
  }
  return work;
}

TEST(LossFactor, IsLinearOverTheLogarithmOfTheFrequency) {
  const LossFactor factor({{1, 0.05}, {100, 0.15}, {200, 0.1}});
  EXPECT_EQ(factor.at(0), 0.05);
  EXPECT_EQ(factor.at(1), 0.05);
  EXPECT_NEAR(factor.at(10), 0.1, 1e-15);
  EXPECT_EQ(factor.at(100), 0.15);
  EXPECT_NEAR(factor.at(100 * std::sqrt(2)), 0.125, 1e-15);
  EXPECT_EQ(factor.at(1e6), 0.1);
  EXPECT_EQ(factor.largest(), 0.15);
  EXPECT_EQ(LossFactor(0.3).at(17), 0.3);
}

/// E(omega) / E_0 = 1 + sum of E_k i omega tau / (1 + i omega tau).
std::complex<double> relaxing_modulus(const std::vector<std::pair<double, double>>& branches,
                                      double frequency) {
  std::complex<double> modulus = 1;
  for (const auto& [stiffness, time] : branches) {
    const std::complex<double> x(0, 2 * pi * frequency * time);
    modulus += stiffness * x / (1.0 + x);
  }
  return modulus;
}

/// Its loss factor as a table.
LossFactor tabulated(const std::vector<std::pair<double, double>>& branches) {
  std::vector<LossFactor::Point> table;
  for (double frequency = 0.1; frequency < 1e4; frequency *= 1.002) {
    const auto modulus = relaxing_modulus(branches, frequency);
    table.push_back({frequency, modulus.imag() / modulus.real()});
  }
  return LossFactor(std::move(table));
}

// Every harmonic loses 4 pi n tan(delta) W_n with the loss factor at its frequency.
TEST(RollingResistance, OfHarmonicsIsWhatARelaxingMaterialLosesInTime) {
  const std::vector<std::pair<double, double>> branches{{0.3, 0.02}, {0.2, 0.4}};
  const double period = 1.3;
  const int n = 1 << 15;
  const TurnHarmonics turn(64, 8);
  const auto strain = [&](double t) {  // of a turn, with a contact that passes: smooth, and without symmetry
    const double x = 2 * pi * t;
    return std::exp(-20 * (1 - std::cos(x))) + 0.3 * std::exp(-5 * (1 - std::cos(x - 1))) + 0.1 * std::sin(x);
  };
  std::vector<double> fine;
  for (int i = 0; i < n; ++i) fine.push_back(strain(i / double(n)));
  Matrix history(turn.n_cases(), 1);
  for (int i = 0; i < 64; ++i)
    for (int s = 0; s < 8; ++s) history(i * 8 + s, 0) = strain((i / 64.0 - s) / 8);
  const Matrix amplitudes = product(turn.waves(), Op::transpose, history, Op::none);
  std::vector<double> energies(turn.n_harmonics(), 0.0);
  for (int wave = 0; wave < turn.n_cases(); ++wave) {
    const int k = TurnHarmonics::harmonic(wave);
    energies[k] += 0.5 * relaxing_modulus(branches, k / period).real() * amplitudes(wave, 0) *
                   amplitudes(wave, 0) / turn.n_cases();
  }
  RollingModel<2> wheel = small_model();
  wheel.distributed.angular_speed = 2 * pi / period;
  const auto factors = loss_factors(wheel, turn.n_harmonics(), tabulated(branches));
  const auto forces = forces_by_energy<2>(wheel.grid, factors);
  const double lost = 2 * pi * wheel.grid.outer_radius *
                      std::inner_product(energies.begin(), energies.end(), forces.begin(), 0.0);
  const double in_time = lost_in_time(fine, period, branches);
  EXPECT_NEAR(lost, in_time, 1e-6 * in_time);
}

TEST(RollingResistance, EnergiesOfTheHarmonicsSumToTheStrainEnergy) {
  for (const auto& model : {small_model(), lopsided_model()}) {
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto state = solved(*problem, lopsided_holes(model.grid));
    const auto& energies = state->energy_by_harmonic();
    ASSERT_EQ(energies.size(), 33);
    const double mean = total(state->strain_energy()) / model.n_positions;
    EXPECT_NEAR(total(energies), mean, 1e-11 * mean);
    for (const double energy : energies) EXPECT_GT(energy, 0);
  }
}

/// All strain energy at once, and by quadrature: with cords of no stiffness nothing is the rest.
RollingModel<2> by_quadrature(RollingModel<2> model) {
  model.materials = Materials<2>(model.materials.layers(), {{0.24, 1e-9}});
  return model;
}

// By the work of the loads and by the strains of every point. The energy of a projected dilatation and of the
// ghost penalty is not one of the strains.
TEST(RollingResistance, BothWaysAgree) {
  for (auto model : {small_model(), lopsided_model(), layered_model()}) {
    model.dilatation = DilatationKind::pointwise;
    model.ghost.xi = 1e-9;
    model.cut_points = 4;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto psi = lopsided_holes(model.grid);
    const std::vector<ShapeFunction<2>> functions{function("work", model),
                                                  function("quadrature", by_quadrature(model))};
    const auto evaluated = evaluate<2>(*problem, functions, psi);
    ASSERT_TRUE(evaluated) << evaluated.failure().detail;
    const auto& both = evaluated->evaluation.functions;
    EXPECT_GT(both[0].value, 0);
    EXPECT_NEAR(both[1].value, both[0].value, 1e-12 * both[0].value);
    EXPECT_LT(testing::relative_difference(both[1].gradient, both[0].gradient), 1e-10);
    const auto state = solved(*problem, psi);
    double of_layers = 0;
    for (const auto& layer : resistance_of_layers<2>(*problem, *state)) of_layers += total(layer);
    EXPECT_NEAR(of_layers, both[0].value, 1e-10 * both[0].value);
  }
}

TEST(RollingResistance, OfPartsSumsToThatOfTheRing) {
  const auto model = layered_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const double all = resistance(*problem, psi), in = resistance(*problem, psi, inside()),
               out = resistance(*problem, psi, outside());
  EXPECT_NEAR(in + out, all, 1e-10 * all);
  EXPECT_GT(in, 0);
  EXPECT_GT(out, in);
  const auto losses = rolling_losses<2>(*problem, psi, *solved(*problem, psi));
  ASSERT_TRUE(losses && *losses);
  EXPECT_EQ((*losses)->by_layer.size(), 3);
  EXPECT_NEAR((*losses)->resistance, all, 1e-10 * all);
  EXPECT_EQ((*losses)->by_layer[1], 0);
  EXPECT_NEAR((*losses)->by_layer[0], in, 1e-10 * all);
}

// The energy of cords is part of the strain energy; they lose none of it.
TEST(RollingResistance, CordsHaveNoLosses) {
  auto model = small_model();
  model.materials = Materials<2>(model.materials.layers(), {{0.32, 2e7}});
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  const auto state = solved(*problem, psi);
  const auto& energy = state->energy_by_harmonic();
  const auto by_energy = forces_by_energy<2>(model.grid, std::vector<double>(energy.size(), 0.2));
  const double with_cords = std::inner_product(energy.begin(), energy.end(), by_energy.begin(), 0.0),
               found = resistance(*problem, psi);
  EXPECT_LT(found, 0.999 * with_cords);
  EXPECT_NEAR(total(resistance_of_layers<2>(*problem, *state)[0]), found, 1e-10 * found);
}

/// The layered wheel at a speed, with loss factors over the frequency.
RollingModel<2> model_at_speed(const std::vector<LossFactor>& factors) {
  auto model = layered_model();
  std::vector<Materials<2>::Layer> layers = model.materials.layers();
  for (std::size_t k = 0; k < layers.size(); ++k) {
    Material material = *layers[k].law->isotropic();
    material.loss_factor = factors[k];
    layers[k].law = std::make_shared<IsotropicLaw<2>>(material);
  }
  model.materials = Materials<2>(std::move(layers));
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed.angular_speed = 40;
  model.tread.observes_spin = true;
  model.cut_points = 8;
  return model;
}

/// One number at all frequencies has the same bytes as a table of equal numbers.
TEST(RollingResistance, OfATableOfEqualFactorsIsThatOfTheNumber) {
  const auto table = [](double number) { return LossFactor({{2, number}, {30, number}, {400, number}}); };
  const auto number = model_at_speed({0.05, 0.0, 0.2}),
             equal = model_at_speed({table(0.05), table(0), table(0.2)});
  const auto problem = RollingProblem<2>::create(number);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto psi = lopsided_holes(number.grid);
  const auto evaluated = [&](const RollingModel<2>& model) {
    return evaluate<2>(*problem, std::vector<ShapeFunction<2>>{function("resistance", model)}, psi);
  };
  const auto of_number = evaluated(number), of_table = evaluated(equal);
  ASSERT_TRUE(of_number && of_table);
  const auto &a = of_number->evaluation.functions[0], &b = of_table->evaluation.functions[0];
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.gradient, b.gradient);
}

const std::vector<LossFactor> factors_over_the_frequency{LossFactor({{1, 0.3}, {100, 0.02}}), 0.1,
                                                         LossFactor({{5, 0.05}, {50, 0.1}, {500, 0.3}})};

/// By harmonics, each with the loss factor at its frequency: as if it were the only number.
TEST(RollingResistance, HasTheLossFactorOfEachHarmonic) {
  const auto model = model_at_speed(factors_over_the_frequency);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto psi = lopsided_holes(model.grid);
  const auto found = rolling_losses<2>(*problem, psi, *solved(*problem, psi));
  const auto at_unit = RollingProblem<2>::create(model_at_speed({1.0, 1.0, 1.0}));
  ASSERT_TRUE(found && *found && at_unit);
  const auto unit = resistance_of_layers<2>(*at_unit, *solved(*at_unit, psi));
  double expected = 0;
  for (std::size_t n = 0; n < unit[0].size(); ++n)
    for (const std::size_t layer : {0, 1, 2})
      expected +=
          unit[layer][n] * factors_over_the_frequency[layer].at(static_cast<double>(n) * 40 / (2 * pi));
  EXPECT_NEAR((*found)->resistance, expected, 1e-12 * expected);
  EXPECT_NEAR(resistance(*problem, psi), expected, 1e-9 * expected);
}

TEST(RollingResistance, IsThatOfAnyOtherSectorAndOfTheImage) {
  const auto model = small_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const double a = model.grid.sector_angle(), column = a / model.grid.cells[1];
  const auto turned = [&](double by, double sign) {
    return resistance(*problem, testing::holes(model.grid, 2,
                                               {{0.2513, sign * 0.04 * a + by, 0.0213},
                                                {0.2731, sign * 0.53 * a + by, 0.0267}}));
  };
  const double here = turned(0, 1);
  EXPECT_NEAR(turned(3 * column, 1), here, 1e-9 * here);
  EXPECT_NEAR(turned(a, -1), here, 1e-9 * here);
}

TEST(RollingResistance, LeavesNothingOutWhereTheLastHarmonicsAreRounding) {
  EXPECT_EQ(resistance_beyond(std::vector<double>{0, 1, 1e-30, -5.8e-30}), 0);  // a bushing has one harmonic
  EXPECT_EQ(resistance_beyond(std::vector<double>{0, 1, 0.5, 0.25}), 0.75);
  EXPECT_EQ(resistance_beyond(std::vector<double>{0, 0, 0, 0}), 0);
}

// Positions of a symmetric wheel that stand for their images do not suffice; rolling_losses() solves all.
TEST(RollingResistance, OfASymmetricWheelNeedsAllPositions) {
  const auto model = small_model();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  const auto half = problem->states(psi, problem->distinct_positions(psi), Interrupt());
  ASSERT_TRUE(half);
  ASSERT_TRUE((*half)->positions().stand_for_images());
  const auto losses = rolling_losses<2>(*problem, psi, **half);
  ASSERT_TRUE(losses && *losses);
  EXPECT_NEAR((*losses)->resistance, resistance(*problem, psi), 1e-9 * (*losses)->resistance);
  EXPECT_NEAR((*losses)->coefficient, (*losses)->resistance / model.load, 1e-9 * (*losses)->coefficient);
}

// As tables, pages and JSON show it: on the whole width, nothing without loss factors.
TEST(RollingResistance, IsANumberOfTheWheel) {
  for (const bool has_loss_factor : {true, false}) {
    auto model = small_model();
    if (!has_loss_factor) model.materials = Material{200e6, 0.3};
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto psi = testing::paper_holes(model.grid);
    const auto states = problem->states(psi, problem->distinct_positions(psi), Interrupt());
    const auto wheel = described_solution<2>(*problem, psi, 0.5, states, {});
    const auto value = [&](std::string_view key) {
      return known_value(*std::ranges::find(wheel_numbers<2>(), key, &WheelNumber<2>::key), wheel);
    };
    EXPECT_EQ(value("rolling_resistance_N").has_value(), has_loss_factor);
    EXPECT_EQ(value("rolling_resistance_unresolved_N").has_value(), has_loss_factor);
    if (!has_loss_factor) continue;
    const double force = resistance(*problem, psi) * model.grid.width;
    EXPECT_NEAR(*value("rolling_resistance_N"), force, 1e-9 * force);
    EXPECT_NEAR(*value("rolling_resistance_coefficient"), force / *value("load_N"), 1e-9);
  }
}

TEST(RollingResistance, WithoutLossFactorsThereIsNone) {
  auto model = small_model();
  model.materials = Material{200e6, 0.3};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = lopsided_holes(model.grid);
  EXPECT_FALSE(rolling_losses<2>(*problem, psi, *solved(*problem, psi)));
}

/// The Taylor tests of the functions at a shape without symmetry.
void expect_second_order(const RollingModel<2>& model, const std::vector<ShapeFunction<2>>& functions,
                         const LoadCases<2>& cases = {}) {
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto psi = generic_hole(model.grid);
  for (const auto& function : functions) {
    const auto test = taylor_test<2>(
        [&](const LevelSet<2>& shape) -> Expected<Evaluation<2>> {
          auto evaluated = evaluate<2>(*problem, functions, shape, nullptr, {}, cases);
          if (!evaluated) return evaluated.failure();
          return std::move(evaluated->evaluation);
        },
        psi, testing::smooth_direction(psi.lattice), model.degree, 2e-5, 3, function.name);
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9) << function.name;
    EXPECT_GT(std::abs(test->derivative) * test->steps.front(), 20 * test->remainders.front())
        << function.name;
  }
}

TEST(RollingResistance, PassesTheTaylorTest) {
  for (const double nu : {0.3, 0.48, 0.4999})
    for (auto model : {small_model(), lopsided_model()}) {
      SCOPED_TRACE(nu);
      model.materials = lossy(0.2, Plane::strain, nu);
      const auto energy = std::make_shared<StrainEnergy<2>>();
      auto mixed = function("with the energy", model);
      mixed.terms.push_back({0.3, energy});
      expect_second_order(model, {function("resistance", model), mixed});
    }
}

TEST(RollingResistance, PassesTheTaylorTestInPlaneStressAndOnARefinedTread) {
  auto model = lopsided_model();
  model.materials = lossy(0.2, Plane::stress, 0.4);
  model.tread.levels = 1;
  expect_second_order(model, {function("resistance", model)});
}

TEST(RollingResistance, OfLayersPassesTheTaylorTest) {
  auto model = layered_model();
  model.contact.friction = 0.4;
  model.torque = 200;
  expect_second_order(model, {function("resistance", model), function("inside", model, inside()),
                              function("outside", model, outside())});
  model.materials = Materials<2>(model.materials.layers(), {{0.32, 2e6}});
  expect_second_order(model, {function("resistance", model)});
}

TEST(RollingResistance, CoefficientPassesTheTaylorTest) {
  for (auto model : {lopsided_model(), small_model()}) {
    if (model.torque == 0) model.travel = 1e-3;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    expect_second_order(model, {{"coefficient", {coefficient(*problem)}}});
  }
}

TEST(RollingResistance, OfSeveralLoadsPassesTheTaylorTest) {
  RollingModel<2> drive = lopsided_model();
  drive.tread.observes_spin = true;
  drive.cut_points = 8;
  RollingModel<2> kerb = drive;
  kerb.load *= 2;
  kerb.torque = 0;
  kerb.horizontal_force = -500;
  kerb.distributed = {{2e4, 1e4}, 1e4, 80};
  const auto both = std::make_shared<RollingResistance<2>>(drive);
  expect_second_order(drive, {{"both", {{1, both, 0}, {0.4, both, 1}}}}, {{"drive", drive}, {"kerb", kerb}});
}

/// Each load has the frequencies of its own speed.
TEST(RollingResistance, OverTheFrequencyPassesTheTaylorTest) {
  const auto drive = model_at_speed(factors_over_the_frequency);
  auto slow = drive;
  slow.distributed.angular_speed = 3;
  slow.load *= 1.5;
  const auto both = std::make_shared<RollingResistance<2>>(drive);
  expect_second_order(drive, {{"both", {{1, both, 0}, {0.4, both, 1}}}}, {{"drive", drive}, {"slow", slow}});
  const auto problem = RollingProblem<2>::create(drive), of_slow = RollingProblem<2>::create(slow);
  ASSERT_TRUE(problem && of_slow);
  const auto psi = lopsided_holes(drive.grid);
  const auto state = solved(*problem, psi)->under(slow, Interrupt());
  ASSERT_TRUE(state);
  const double expected = resistance(*of_slow, psi);
  EXPECT_NEAR(*both->evaluate(*problem, psi, **state, {}).over_positions, expected, 1e-9 * expected);
}

/// What a case file says, and `check` about it.
TEST(RollingResistance, OverTheFrequencyNeedsASpeed) {
  const auto read = [](const std::string& table, const std::string& load) {
    return parse_case(
        "[material]\ndensity = 1100\nloss_factor = " + table + "\n[load]\nforce = 2000\n" + load,
        "case.toml");
  };
  const std::string table = "[[2, 0.05], [300, 0.12]]";
  const auto good = read(table, "speed = 5\n");
  ASSERT_TRUE(good.value) << good.problems.front().text();
  EXPECT_EQ(good.value->material.loss_factor, LossFactor({{2, 0.05}, {300, 0.12}}));
  EXPECT_EQ(*parse_case(to_toml(*good.value), "case.toml").value, *good.value);
  EXPECT_NE(derived_report(*good.value).find("2.34 Hz (turn)"), std::string::npos)
      << derived_report(*good.value);
  const auto warns = [&](const CaseResult& result) {
    return std::ranges::any_of(warnings(*result.value), [](const std::string& text) {
      return text.starts_with("material.loss_factor is given from 2 to 300 Hz");
    });
  };
  EXPECT_FALSE(warns(good));
  EXPECT_TRUE(warns(read(table, "speed = 1\n")));
  EXPECT_EQ(read(table, "").problems.size(), 1);
  EXPECT_EQ(read("[[300, 0.05], [2, 0.12]]", "speed = 5\n").problems.size(), 1);
  EXPECT_EQ(read("[[2, 0.05]]", "speed = 5\n").problems.size(), 1);
  EXPECT_EQ(read("[[0, 0.05], [2, 0.12]]", "speed = 5\n").problems.size(), 1);
  EXPECT_EQ(read("[2, 0.05]", "speed = 5\n").problems.size(), 1);
  EXPECT_TRUE(read("0.1", "").value);
  EXPECT_TRUE(
      read(table, "[[load.case]]\nname = \"rolling\"\nspeed = 5\n[[load.case]]\nname = \"kerb\"\n").value);
}

RollingModel<3> solid_model(int axial_cells) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, axial_cells}};
  model.degree = 1;
  model.materials = lossy(0.2);
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  return model;
}

/// A hole that varies along the axle.
LevelSet<3> uneven_hole(const PolarGrid<3>& grid) {
  const Circle hole{0.2581, 0.47 * grid.sector_angle(), 0.0273};
  auto psi = make_level_set<3>(Lattice<3>(grid, 1), std::span(&hole, 1));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    psi.values[i] += 0.002 * std::cos(20 * psi.lattice.polar_point(i)[2]);
  return psi;
}

TEST(RollingResistance, PassesTheTaylorTestIn3D) {
  auto model = solid_model(2);
  model.contact.friction = 0.5;
  model.torque = 120;
  model.lateral_force = 350;
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto psi = uneven_hole(model.grid);
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  const auto test = taylor_test<3>(
      [&](const LevelSet<3>& shape) {
        return testing::evaluate_objective<3>(*problem, {{1, std::make_shared<RollingResistance<3>>(model)}},
                                              shape);
      },
      psi, direction, model.degree, 2e-5, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  for (const double order : test->orders) EXPECT_GT(order, 1.9);
}

TEST(RollingResistance, OfHalfOfTheWidthIsHalf) {
  const auto model = solid_model(4);
  const auto whole = RollingProblem<3>::create(model);
  const auto half = HalfWidthSolver::create(model);
  ASSERT_TRUE(whole && half);
  ASSERT_TRUE(HalfWidthSolver::can_halve(model));
  const auto psi = mirror_symmetric_part(uneven_hole(model.grid), MirrorPlane::width);
  const ShapeFunction<3> function{"resistance", {{1, std::make_shared<RollingResistance<3>>(model)}}};
  const auto a = evaluate<3>(*whole, std::span(&function, 1), psi),
             b = evaluate<3>(**half, std::span(&function, 1), psi);
  ASSERT_TRUE(a && b);
  const auto &of_whole = a->evaluation.functions[0], &of_half = b->evaluation.functions[0];
  EXPECT_NEAR(of_half.value, of_whole.value, 1e-11 * of_whole.value);
  EXPECT_NEAR(total(of_half.gradient), total(of_whole.gradient), 1e-7 * std::abs(total(of_whole.gradient)));
}

/// F / (P tan(delta)) of a ring without holes.
RollingLosses of_full_ring(const RollingModel<2>& model) {
  const auto problem = RollingProblem<2>::create(model);
  if (!problem) throw std::runtime_error(problem.failure().detail);
  const auto psi = testing::holes(model.grid, 2, {});
  return **rolling_losses<2>(*problem, psi, *solved(*problem, psi));
}

// Series solutions of the ring with complex moduli, the contact solved anew, give F / (P tan(delta)) =
// 0.015408467 in the limit of small loss factors. The positions leave out a share that falls as the square of
// their number.
TEST(RollingResistance, OfARingWithoutHolesIsExact) {
  constexpr double exact = 0.015408467;
  auto model = paper_model(28, 384);
  model.materials = lossy(1, Plane::strain, 0.48);
  model.tread.levels = 3;
  std::vector<RollingLosses> losses;
  for (const int n_positions : {24, 48, 96, 192}) {
    model.n_positions = n_positions;
    losses.push_back(of_full_ring(model));
    if (losses.size() > 1) {
      const auto& before = losses[losses.size() - 2];
      EXPECT_LT(std::abs(losses.back().resistance - before.resistance), before.beyond);
    }
  }
  EXPECT_NEAR(losses.back().coefficient, exact, 1e-3 * exact);
  // What check says without solving.
  Case c;
  for (const int k : {0, 1}) {
    c.load.positions = 24 << k;
    const double missing = 1 - losses[k].coefficient / exact;
    EXPECT_GT(unresolved_losses(c), missing);
    EXPECT_LT(unresolved_losses(c), 2 * missing);
  }
  c.load.positions = positions_for_losses(c, 0.01);
  EXPECT_LE(unresolved_losses(c), 0.01);
  --c.load.positions;
  EXPECT_GT(unresolved_losses(c), 0.01);
}

/// F / (P tan(delta)) of a disc on a pin, relative to that of a half-plane under Hertz's pressure, 8 / (3 pi)
/// a / R.
double by_half_plane(double half_width_by_radius, int levels, int n_positions) {
  RollingModel<2> model;
  model.grid = {0.01, 0.34, 0.12, 384, {28, 1}};
  const Material material = lossy(1, Plane::strain, 0.3);
  model.materials = material;
  const double a = half_width_by_radius * 0.34;
  model.load = pi * material.contact_modulus() * a * a / (4 * 0.34);
  model.tread.levels = levels;
  model.n_positions = n_positions;
  return of_full_ring(model).coefficient / (8 / (3 * pi) * half_width_by_radius);
}

// With 39 cells across the patch. The positions leave out 0.1 %.
TEST(RollingResistance, OfALargeDiscIsThatOfAHalfPlane) { EXPECT_NEAR(by_half_plane(0.01, 5, 9), 1, 0.01); }

}  // namespace
}  // namespace wheelwright
