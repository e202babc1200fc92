// Estimates of the discretization error: formulas, and that they contain the true errors.

#include "wheelwright/quantities/analysis/discretization_error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <map>
#include <numbers>

#include "tests/random_wheels.h"
#include "tests/rolling_ring.h"
#include "tests/support.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/output/report/within_errors.h"
#include "wheelwright/quantities/analysis/finer_grid.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::paper_model;

// --- Formulas ----------------------------------------------------------------------------------------------

/// q(h) = exact + h^order.
double at_size(double h, double order) { return 3 + std::pow(h, order); }

TEST(DiscretizationError, IsTheErrorOfTheFirstOrderTimesItsSafety) {
  for (const double r : {4.0 / 3, 2.0})
    for (const double h : {0.1, 0.03})
      EXPECT_NEAR(discretization_error(at_size(h, 1), at_size(h / r, 1), r), 2 * h, 1e-12);
}

TEST(DiscretizationError, IsLargerThanTheErrorOfHigherOrders) {
  for (const double r : {4.0 / 3, 2.0})
    for (const double order : {1.0, 1.5, 2.0, 4.0}) {
      const double h = 0.1, error = std::pow(h, order);
      const double stated = discretization_error(at_size(h, order), at_size(h / r, order), r);
      EXPECT_NEAR(stated / error, 2 * (1 - std::pow(r, -order)) / (1 - 1 / r), 1e-9);
      EXPECT_GT(stated, error);
      EXPECT_LT(stated, 6 * error);
    }
}

TEST(DiscretizationError, OfAnExtremeIsTwiceAsLarge) {
  EXPECT_EQ(discretization_error(1, 1.5, 2, Converges::as_an_extreme), 2 * discretization_error(1, 1.5, 2));
}

TEST(DiscretizationError, OnTheFinerGridIsThatOfTheFirstOrderThereTimesItsSafety) {
  for (const double r : {4.0 / 3, 2.0})
    for (const double h : {0.1, 0.03})
      EXPECT_NEAR(error_on_finer_grid(at_size(h, 1), at_size(h / r, 1), r), 2 * h / r, 1e-12);
}

TEST(DiscretizationError, OfPositionsIsAtLeastTheirUsualOne) {
  const std::vector<double> values{1, 2, 3, 4}, on_finer{1, 2.3, 3, 3.7};
  const auto errors = discretization_errors(values, on_finer, 2);
  const double usual = std::sqrt((0.09 + 0.09) / 4);
  EXPECT_NEAR(errors[0], 4 * usual, 1e-12);
  EXPECT_NEAR(errors[1], 4 * 0.3, 1e-12);
  EXPECT_NEAR(errors[2], 4 * usual, 1e-12);
}

TEST(ObservedOrder, IsThatOfAnExactSequence) {
  for (const double r : {4.0 / 3, 2.0})
    for (const double order : {-0.5, 0.5, 1.0, 2.0, 3.0})
      EXPECT_NEAR(
          *observed_order(at_size(0.1, order), at_size(0.1 / r, order), at_size(0.1 / r / r, order), r),
          order, 1e-6);
  EXPECT_FALSE(observed_order(1, 2, 2, 2));
  EXPECT_FALSE(observed_order(1, 1, 2, 2));
}

TEST(ValueWithError, HasTheSameDigitsAsItsError) {
  EXPECT_EQ(text_with_error(0.380105, 0.00077), "0.3801 +- 0.0008");
  EXPECT_EQ(text_with_error(7742.61, 23), "7740 +- 30");
  EXPECT_EQ(text_with_error(-1.23456, 0.0131), "-1.235 +- 0.014");
  EXPECT_EQ(text_with_error(0.012, 0.4), "0.0 +- 0.4");
  EXPECT_EQ(text_with_error(9.99, 0.0996), "9.99 +- 0.10");
}

TEST(ValueWithError, LeavesOutWhatRoundingHides) {
  EXPECT_EQ(text_with_error(2943, 0), "2943");
  EXPECT_EQ(text_with_error(2943, 1e-5), "2943");
  EXPECT_EQ(text_with_error(2943, NAN), "2943");
  EXPECT_EQ(text_with_error(0, 0), "0");
}

TEST(ValueWithError, OfALifeIsARangeByAFactor) {
  const auto life = [](double value, double error) {
    return text_with_error(value, error, UnitKind::distance);
  };
  EXPECT_EQ(life(120, 360), "120 (30 to 480)");  // a factor of 4
  EXPECT_EQ(life(1.23e6, 1.23e6), "1.2e+06 (620000 to 2.5e+06)");
  EXPECT_EQ(life(120, 3), "120 +- 3");
  EXPECT_EQ(life(120, 0), "120");
  EXPECT_EQ(text_with_error(120, 360, UnitKind::force), text_with_error(120, 360));
}

TEST(DiscretizationError, OfAPowerIsThatOfItsLogarithm) {
  const double r = 2, u = 0.3, finer = 0.33, k = 9;
  const auto life = [&](double utilization) { return 1e6 * std::pow(utilization, -k); };
  const double relative = k * discretization_error(std::log(u), std::log(finer), r, Converges::as_an_extreme),
               error = discretization_error(life(u), life(finer), r, Converges::as_a_power);
  EXPECT_NEAR(1 + error / life(u), std::exp(relative), 1e-9 * std::exp(relative));
  EXPECT_NEAR(1 + error_on_finer_grid(life(u), life(finer), r, Converges::as_a_power) / life(finer),
              std::exp(relative / r), 1e-9 * std::exp(relative / r));
  EXPECT_EQ(discretization_error(5, 5, r, Converges::as_a_power), 0);
}

TEST(ComparisonTable, HasRangesOfLivesAndDifferencesOfTemperatures) {
  ComparedRow life{"fatigue life [km]", {20.0, 120.0}, {0.0, 360.0}},
      temperature{"peak temperature [deg C]", {-1.0, 2.5}};
  life.kind = UnitKind::distance;
  temperature.kind = UnitKind::temperature;
  EXPECT_NE(comparison_table({"a", "b"}, {life}).find(" 120 (30 to 480) "), std::string::npos);
  EXPECT_NE(comparison_table({"a", "b"}, {temperature}).find("+3.50 K"), std::string::npos);
}

TEST(ComparisonTable, MarksChangesThatTheErrorsMayExplain) {
  const ComparedRow small{"run-out", {1.0, 1.01}, {0.004, 0.007}},
      clear{"travel", {1.0, 1.1}, {0.004, 0.007}}, unknown{"mass", {1.0, 1.01}};
  const auto is_marked = [](const ComparedRow& row) {
    return comparison_table({"a", "b"}, {row}).find('~') != std::string::npos;
  };
  EXPECT_TRUE(is_marked(small));
  EXPECT_FALSE(is_marked(clear));
  EXPECT_FALSE(is_marked(unknown));
  EXPECT_NE(comparison_table({"a", "b"}, {small}).find("1.010 +- 0.007"), std::string::npos);
}

using Groups = std::vector<std::vector<std::size_t>>;

/// A harmonic that symmetry forbids is 0 but for rounding.
TEST(ComparisonTable, ShowsRoundingAsZero) {
  const ComparedRow harmonic{"harmonic", {3e-13, 1e-9}, {std::nullopt, 6e-5}};
  const std::string table = comparison_table({"a", "b"}, {harmonic});
  EXPECT_EQ(table.find("e-"), std::string::npos);
  const ComparedRow small{"small", {3e-9, 1e-9}, {std::nullopt, 6e-5}};
  EXPECT_NE(comparison_table({"a", "b"}, {small}).find("3e-09"), std::string::npos);
}

TEST(WithinErrors, GroupsAreThoseOfWhichAnyTwoAreUndecided) {
  const auto groups = [](std::vector<EstimatedValue> values) { return groups_within_errors(values); };
  EXPECT_EQ(groups({{1, 0.1}, {1.3, 0.1}}), Groups{});
  EXPECT_EQ(groups({{1.15, 0.1}, {1, 0.1}}), (Groups{{1, 0}}));
  EXPECT_EQ(groups({{1, 0.1}, {1.05, 0.1}, {1.15, 0.1}, {5, 0.1}}), (Groups{{0, 1, 2}}));
  // A chain: its ends are in order.
  EXPECT_EQ(groups({{1.3, 0.1}, {1, 0.1}, {1.15, 0.1}}), (Groups{{1, 2}, {2, 0}}));
  EXPECT_EQ(groups({{1, 0.1}, {1, 0.1}}), Groups{});
  EXPECT_EQ(groups({{1, 0}, {1, 0}, {1.1, 0.2}}), (Groups{{0, 1, 2}}));
  EXPECT_EQ(groups({}), Groups{});
}

TEST(ComparisonTable, TellsTheWheelsThatAreNotInOrder) {
  const std::vector<ComparedRow> rows{{"travel", {1.0, 2.0, 1.01}, {0.01, 0.01, 0.01}},
                                      {"run-out", {1.0, 1.02, 1.01}, {0.011, 0.011, 0.011}},
                                      {"stiffness", {3.0, 1.02, 3.01}, {0.01, 0.01, 0.01}},
                                      {"mass", {1.0, 1.0, 1.0001}, {}},
                                      {"load", {5.0, 5.0, 5.0}, {0.0, 0.0, 0.0}}};
  const auto undecided = undecided_numbers(rows);
  ASSERT_EQ(undecided.size(), 2u);
  EXPECT_EQ(undecided[0].wheels, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(undecided[0].rows, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(undecided[1].wheels, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(undecided[1].rows, (std::vector<std::size_t>{1}));
  const std::string table = comparison_table({"x", "y", "z"}, rows);
  EXPECT_NE(table.find("x and z differ by less than their errors in travel, stiffness\n"), std::string::npos)
      << table;
}

// --- The finer grid ----------------------------------------------------------------------------------------

TEST(FinerGrid, HasTheSameWheel) {
  const auto model = paper_model(14, 192), finer = on_finer_grid(model);
  const LevelSet<2> psi = testing::paper_holes(model.grid), there = on_grid(psi, finer.grid);
  EXPECT_EQ(refinement(model.grid, finer.grid), 2);
  for (const double t : {0.0, 0.123, 0.5, 0.77, 0.991}) {
    const Vec<2> place{0.2 + 0.14 * t, 7 * t};
    EXPECT_NEAR(value_at<2>(there, place), value_at<2>(psi, place), 1e-15);
  }
  EXPECT_NEAR(finer.tread.rows * finer.grid.row_height(0), model.tread.rows * model.grid.row_height(0),
              1e-15);
  EXPECT_NEAR(dof_bound(model), 2.0 * 29 * 384, 1e-9);
}

RollingModel<3> solid_model(std::array<int, 3> cells) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, cells};
  model.degree = 2;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  return model;
}

TEST(FinerGrid, KeepsHalvesOfTheWidthInThreeDimensions) {
  for (const std::array<int, 3> cells : {std::array{7, 6, 4}, {6, 9, 2}, {12, 12, 6}, {5, 5, 3}}) {
    const auto model = solid_model(cells), finer = on_finer_grid(model);
    for (int d = 0; d < 3; ++d) EXPECT_GE(3 * finer.grid.cells[d], 4 * cells[d]);
    if (cells[2] % 2 == 0) {
      EXPECT_EQ(finer.grid.cells[2] % 2, 0);
    }
    EXPECT_GE(refinement(model.grid, finer.grid), 4.0 / 3 - 1e-12);
  }
}

TEST(FinerGrid, KeepsTheThicknessOfAnObservedAnnulus) {
  auto model = solid_model({7, 6, 2});
  model.tread.annulus_points = 3;
  for (const int rows : {1, 2, 3}) {
    model.tread.rows = rows;
    const auto finer = on_finer_grid(model);
    EXPECT_NEAR(finer.tread.rows * finer.grid.row_height(0), rows * model.grid.row_height(0), 1e-15);
  }
}

// --- True errors -------------------------------------------------------------------------------------------

/// Requested after so much processor time: few of the random wheels take longer.
constexpr double most_seconds = 15;
Interrupt after_seconds(double seconds) {
  return Interrupt(
      [end = std::clock() + seconds * CLOCKS_PER_SEC] { return static_cast<double>(std::clock()) > end; });
}

template <int dim>
DescribedWheel<dim> described_on(const RollingModel<dim>& model, const LevelSet<dim>& psi) {
  const auto solver = make_solver(model);
  if (!solver) throw std::runtime_error(solver.failure().detail);
  const auto states = (*solver)->states(psi, (*solver)->distinct_positions(psi), after_seconds(most_seconds));
  return described_solution<dim>(**solver, psi, material_measure(psi) / sector_measure<dim>(model.grid),
                                 states, {});
}

/// The wheel with its errors, and its grid.
template <int dim>
struct Estimated {
  DescribedWheel<dim> wheel;
  RollingModel<dim> finer;
};

template <int dim>
Estimated<dim> estimated(const RollingModel<dim>& model, const LevelSet<dim>& psi) {
  const auto finer = on_finer_grid(model);
  return {with_errors<dim>(described_on(model, psi),
                           FinerWheel<dim>{described_on(finer, on_grid(psi, finer.grid)),
                                           refinement(model.grid, finer.grid)}),
          finer};
}

/// How often the stated errors contain the true ones, and their ratios.
struct Coverage {
  int contained = 0, all = 0;
  std::vector<double> ratios = {};  ///< stated / true
  std::string misses = {};          ///< in words

  void add(const std::string& key, double stated, double truth, double value, double scale) {
    if (truth <= std::max(1e-8 * std::abs(value), 1e-9 * scale)) return;  // exact up to rounding
    ++all;
    contained += truth <= stated;
    ratios.push_back(stated / truth);
    if (truth > stated)
      misses += fmt::format("; {} is off by {:.2g}, stated {:.2g}", key, truth / std::abs(value),
                            stated / std::abs(value));
  }
  Coverage& operator+=(const Coverage& other) {
    contained += other.contained;
    all += other.all;
    ratios.insert(ratios.end(), other.ratios.begin(), other.ratios.end());
    return *this;
  }
  double share() const { return contained / static_cast<double>(all); }
  double median() {
    std::ranges::nth_element(ratios, ratios.begin() + std::ssize(ratios) / 2);
    return ratios[ratios.size() / 2];
  }
};

/// The size of the numbers from which a number is a difference: the run-out of a ring is rounding.
template <int dim>
double scale_of(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel) {
  const std::string& key = number.key;
  if (!wheel.loaded || !(key.starts_with("run_out") || key.starts_with("force_"))) return 0;
  const RollingAnalysis& rolling = wheel.loaded->rolling;
  return key.starts_with("run_out") ? rolling.travel : rolling.load * whole_width(dim, wheel.grid.width);
}

/// Of the numbers of a grid, and of those of the finer one.
struct Coverages {
  Coverage own = {}, finer = {};
};

/// Adds all numbers of a wheel; the truth is on the grid that is finer than the finer one. False if it cannot
/// be solved there or on the finer one.
template <int dim>
bool add_wheel(const Estimated<dim>& of, const LevelSet<dim>& psi, Coverages& coverages) {
  const auto finest = on_finer_grid(of.finer);
  const DescribedWheel<dim> truth = described_on(finest, on_grid(psi, finest.grid));
  if (!truth.loaded || !(*of.wheel.finer)->wheel.loaded) return false;
  for (const WheelNumber<dim>& number : wheel_numbers<dim>()) {
    const auto value = known_value(number, of.wheel), exact = known_value(number, truth);
    const auto error = error_of(number, of.wheel);
    if (!value || !exact || !error || !*error) continue;
    const FinerWheel<dim>& finer = **of.wheel.finer;
    const double on_finer = *known_value(number, finer.wheel), scale = scale_of(number, of.wheel);
    coverages.own.add(number.key, **error, std::abs(*value - *exact), *value, scale);
    coverages.finer.add(number.key, error_on_finer_grid(*value, on_finer, finer.refinement, number.converges),
                        std::abs(on_finer - *exact), on_finer, scale);
  }
  return true;
}

TEST(DiscretizationError, ContainsThatOfABushing) {
  for (const double nu : {0.3, 0.48, 0.499, 0.4999}) {
    auto model = paper_model(4, 64);
    model.grid.n_sectors = 8;
    model.grid.cells[1] = 8;
    model.materials = Material{2e6, nu};
    model.contact.counterpart = Counterpart::ring;
    model.contact_points = 3;
    model.n_positions = 1;
    const auto [wheel, finer] = estimated(model, testing::holes(model.grid, 2, {}));
    // Kolosov's solution with the displacements of both circles given, as in bushing_test.cc.
    const double kappa = 3 - 4 * nu, a = 0.04, b = 0.1156, mu = 2e6 / (2 * (1 + nu));
    const double stiffness =
        4 * pi * mu * (1 + kappa) / (kappa * std::log(b / a) - 2 / kappa * (b - a) / (b + a)) * 0.12;
    for (const WheelNumber<2>& number : wheel_numbers<2>()) {
      if (number.key != "stiffness_N_per_m") continue;
      const double truth = std::abs(*known_value(number, wheel) - stiffness);
      EXPECT_LE(truth, **error_of(number, wheel)) << nu;
      EXPECT_LE(**error_of(number, wheel), 5 * truth) << nu;
    }
  }
}

double stated_error(const DescribedWheel<2>& wheel, const std::string& key) {
  const auto& numbers = wheel_numbers<2>();
  return **error_of(*std::ranges::find(numbers, key, &WheelNumber<2>::key), wheel);
}

TEST(DiscretizationError, OfANumberThatAgreesByChanceIsAShareOfThatOfTheDisplacements) {
  const auto model = paper_model(4, 64);
  const DescribedWheel<2> wheel = described_on(model, testing::holes(model.grid, 2, {}));
  DescribedWheel<2> finer = wheel;
  ShapeSummary<2>& summary = finer.loaded->summary;
  summary.strain_energy *= 1.01;
  summary.rolling.peak_pressure *= 1 + 1e-6;
  const auto with_error = with_errors<2>(wheel, FinerWheel<2>{finer, 2});
  const double relative = 2 * 0.01 / 0.5;  // of the energy
  EXPECT_NEAR(stated_error(with_error, "strain_energy_J_per_m"),
              relative * wheel.loaded->summary.strain_energy, 1e-9);
  EXPECT_NEAR(stated_error(with_error, "peak_pressure_Pa"),
              least_share_of_error * relative * wheel.loaded->summary.rolling.peak_pressure, 1e-3);
  for (const char* key : {"load_N", "volume_fraction"}) EXPECT_EQ(stated_error(with_error, key), 0) << key;
}

/// That the exact value of a number lies within its stated error; prints both.
void expect_contained(const std::string& what, const DescribedWheel<2>& wheel, const std::string& key,
                      double exact) {
  const auto& numbers = wheel_numbers<2>();
  const auto number = std::ranges::find(numbers, key, &WheelNumber<2>::key);
  ASSERT_NE(number, numbers.end()) << key;
  const double stated = **error_of(*number, wheel), error = std::abs(*known_value(*number, wheel) - exact);
  EXPECT_LE(error, stated) << what << ", " << key;
  std::cout << fmt::format("{}, {}: off by {:.2g} %, stated {:.2g} %\n", what, key, 100 * error / exact,
                           100 * stated / exact);
}

void expect_contained(const std::string& what, const DescribedWheel<2>& wheel,
                      const testing::RollingRing& exact) {
  expect_contained(what, wheel, "mean_travel_m", exact.travel);
  expect_contained(what, wheel, "strain_energy_J_per_m", exact.strain_energy);
  expect_contained(what, wheel, "peak_pressure_Pa", exact.peak_pressure);
  expect_contained(what, wheel, "patch_length_m", 2 * exact.half_width);
}

TEST(DiscretizationError, ContainsThatOfRollingRings) {
  for (const double nu : {0.3, 0.45, 0.48, 0.49, 0.4999}) {
    auto model = paper_model(14, 192);
    model.materials = Material{200e6, nu};
    model.tread.levels = 4;
    model.n_positions = 1;
    const auto exact = testing::RollingRingSeries(0.20, 0.34, Material{200e6, nu}).at(0.0188);
    model.load = exact.load;
    expect_contained(fmt::format("ring, nu {}", nu),
                     estimated(model, testing::holes(model.grid, 2, {})).wheel, exact);
  }
}

/// A solid roller, of 5 cm with a rim of 1 mm, whose case sets no key of the grid.
RollingModel<2> roller(double nu, double force) {
  const std::string text = fmt::format(
      "[wheel]\ninner_radius = 0.001\nouter_radius = 0.05\nwidth = 1\nsectors = 8\n"
      "[material]\nyoungs_modulus = 52.5e9\npoissons_ratio = {}\n[load]\npositions = 1\nforce = {}\n",
      nu, force);
  return rolling_model<2>(with_levels_of_results(*parse_case(text, "roller.toml").value));
}

TEST(DiscretizationError, ContainsThatOfRollers) {
  for (const double nu : {0.3, 0.45, 0.48, 0.49, 0.4999}) {
    const auto exact = testing::RollingRingSeries(0.001, 0.05, Material{52.5e9, nu}).at(0.123);
    const auto model = roller(nu, exact.load);
    expect_contained(fmt::format("roller, nu {}", nu),
                     estimated(model, testing::holes(model.grid, 2, {})).wheel, exact);
  }
}

/// Hertz's theory of a cylinder on a half-plane is off by the square of half-width by radius, here 2.5e-5.
TEST(DiscretizationError, ContainsThatOfHertz) {
  const Material material{52.5e9, 0.3};
  const double radius = 0.05, half_width = 0.005 * radius, modulus = material.contact_modulus();
  const double load = pi * modulus * half_width * half_width / (4 * radius),
               peak_pressure = 2 * load / (pi * half_width);
  const auto exact = testing::RollingRingSeries(0.001, radius, material).at(half_width / radius);
  EXPECT_NEAR(exact.load / load, 1, 1e-4);
  EXPECT_NEAR(exact.peak_pressure / peak_pressure, 1, 1e-4);
  const auto model = roller(material.poissons_ratio, load);
  const auto wheel = estimated(model, testing::holes(model.grid, 2, {})).wheel;
  expect_contained("Hertz", wheel, "peak_pressure_Pa", peak_pressure);
  expect_contained("Hertz", wheel, "patch_length_m", 2 * half_width);
}

TEST(DiscretizationError, ContainsThatOfAWheelWithoutSymmetry) {
  auto model = paper_model(10, 128);
  model.grid.n_sectors = 8;
  model.grid.cells[1] = 16;
  model.tread.levels = 2;
  model.n_positions = 4;
  const auto psi =
      testing::holes(model.grid, 2, {{0.26, 0.3 * model.grid.sector_angle(), 0.03}, {0.285, 0.62, 0.015}});
  Coverages coverages;
  ASSERT_TRUE(add_wheel(estimated(model, psi), psi, coverages));
  for (Coverage* coverage : {&coverages.own, &coverages.finer}) {
    EXPECT_GE(coverage->all, 10);
    EXPECT_EQ(coverage->contained, coverage->all);
  }
  EXPECT_LE(coverages.own.median(), 8);  // of a single wheel, which converges faster than the first order
}

TEST(DiscretizationError, ContainsThatOfASolidWheelWithoutSymmetry) {
  const auto model = solid_model({6, 6, 2});
  const Circle hole{0.2581, 0.4 * model.grid.sector_angle(), 0.03};
  const auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  Coverages coverages;
  ASSERT_TRUE(add_wheel(estimated(model, psi), psi, coverages));
  for (const Coverage& coverage : {coverages.own, coverages.finer}) {
    EXPECT_GE(coverage.all, 10);
    EXPECT_GE(coverage.share(), 0.9);
  }
}

/// Without it, all load positions are solved.
template <int dim>
bool is_symmetric(const RollingModel<dim>& model, const LevelSet<dim>& psi) {
  return is_mirror_symmetric(model) && is_mirror_symmetric(psi);
}

/// Wheels of both dimensions, half of them without mirror symmetry.
class RandomSample {
 public:
  RandomSample(unsigned seed, int plane, int solid)
      : wheels_(seed), missing_{{2, {plane / 2, plane / 2}}, {3, {solid / 2, solid / 2}}} {}

  Coverages coverages() {
    while (!is_complete()) {
      const CaseResult read = parse_case(to_toml(wheels_.draw()), "random.toml");
      if (read.value)
        in_dimension_of(*read.value, [&](auto dim) {
          add<dim>(*read.value);
          return 0;
        });
    }
    return coverages_;
  }

 private:
  bool is_complete() const {
    return std::ranges::all_of(missing_, [](const auto& of) { return of.second == std::array{0, 0}; });
  }

  /// Unless enough of its kind are there, it is too large for a test, or it cannot be solved. A travel of a
  /// third of the ring is far beyond linear elasticity.
  template <int dim>
  void add(const Case& c) {
    constexpr double most = dim == 2 ? 5e5 : 1.5e5;
    const auto model = rolling_model<dim>(c);
    if (dof_bound(on_finer_grid(on_finer_grid(model))) > most || !make_solver(model)) return;
    const LevelSet<dim> psi = initial_shape<dim>(c);
    int& missing = missing_.at(dim)[is_symmetric(model, psi)];
    if (missing == 0) return;
    const auto of = estimated(model, psi);
    if (!of.wheel.loaded || of.wheel.loaded->deformation.travel > 0.3) return;
    Coverages of_wheel;
    if (!add_wheel(of, psi, of_wheel)) return;
    const Coverage& own = of_wheel.own;
    --missing;
    std::cout << dim << "D, " << (is_symmetric(model, psi) ? "symmetric: " : "without symmetry: ")
              << own.contained << " of " << own.all << " numbers within their errors" << own.misses
              << std::endl;
    coverages_.own += own;
    coverages_.finer += of_wheel.finer;
  }

  testing::AnyWheels wheels_;
  std::map<int, std::array<int, 2>> missing_;  ///< [dimension][is it symmetric]
  Coverages coverages_;
};

TEST(DiscretizationError, ContainsThatOfRandomWheelsSlow) {
  Coverages coverages = RandomSample(5, 40, 20).coverages();
  for (Coverage* coverage : {&coverages.own, &coverages.finer}) {
    std::cout << coverage->all << " numbers, " << 100 * coverage->share()
              << " % within the stated error, median of stated by true error " << coverage->median() << "\n";
  }
  EXPECT_GE(coverages.own.share(), 0.95);
  EXPECT_GE(coverages.finer.share(), 0.9);
  EXPECT_LE(coverages.own.median(), 5);
}

}  // namespace
}  // namespace wheelwright
