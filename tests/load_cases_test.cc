#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support.h"
#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"
#include "wheelwright/run/study/bounded_functions.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using testing::smooth_direction;

/// Two holes of different sizes, one across the sector's face: no symmetry at all.
LevelSet<2> lopsided_holes(const PolarGrid<2>& grid) {
  const double a = grid.sector_angle();
  return testing::holes(grid, 2, {{0.2513, 0.04 * a, 0.0213}, {0.2731, 0.53 * a, 0.0267}});
}

/// A driven wheel, and the same wheel under twice the load, at speed and with other loads on its structure.
LoadCases<2> two_loads() {
  RollingModel<2> drive = testing::paper_model(14, 192);
  drive.contact.friction = 0.4;
  drive.n_positions = 3;
  drive.torque = 200;
  drive.tread.observes_spin = true;
  drive.cut_points = 8;  // the derivative of an integral over cut cells is exact up to their quadrature
  Material material = *drive.materials.at_tread().isotropic();
  material.density = 1200;
  drive.materials = material;
  RollingModel<2> kerb = drive;
  kerb.load *= 2;
  kerb.torque = 0;
  kerb.horizontal_force = -500;
  kerb.distributed = {{2e4, 1e4}, 1e4, 80};
  return {{"drive", drive}, {"kerb", kerb}};
}

/// The strain energy of both loads, and of the second one alone a uniformity, which compares with that load's
/// own mean, and the p-norm of the stress.
std::vector<ShapeFunction<2>> functions_of_both() {
  const auto energy = std::make_shared<StrainEnergy<2>>();
  const auto uniformity = std::make_shared<UniformityL2<2>>(0.01);
  const auto stress = std::make_shared<PeakVonMises<2>>(0.025, PeakNorm{.correction = 1});
  return {objective<2>({{1, energy, 0}, {0.3, energy, 1}, {50, uniformity, 1}}),
          {.name = "stress", .terms = {{1e-6, stress, 1}}},
          {.name = "second position", .terms = {{1, energy, 1}}, .position_weights = {0, 1, 0}}};
}

Expected<Evaluated<2>> evaluated_under(const LoadCases<2>& loads,
                                       const std::vector<ShapeFunction<2>>& functions,
                                       const LevelSet<2>& psi) {
  const auto problem = RollingProblem<2>::create(loads.front().model);
  return evaluate<2>(*problem, functions, psi, nullptr, {}, loads);
}

TEST(LoadCases, EveryFunctionPassesTheTaylorTest) {
  const LoadCases<2> loads = two_loads();
  const auto problem = RollingProblem<2>::create(loads.front().model);
  ASSERT_TRUE(problem);
  const auto psi = testing::generic_hole(problem->model().grid);
  const auto functions = functions_of_both();
  for (const auto& function : functions) {
    const auto test = taylor_test<2>(
        [&](const LevelSet<2>& shape) -> Expected<Evaluation<2>> {
          auto evaluated = evaluate<2>(*problem, functions, shape, nullptr, {}, loads);
          if (!evaluated) return evaluated.failure();
          return std::move(evaluated->evaluation);
        },
        psi, smooth_direction(psi.lattice), 2, 4e-5, 3, function.name);
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders)
      EXPECT_GT(order, 1.9) << function.name << " " << test->remainders.back() << " of " << test->value;
  }
}

// Every load as the only load of a problem of its own, with a factorization of its own.
TEST(LoadCases, AreSumsOfSingleLoads) {
  const LoadCases<2> loads = two_loads();
  const auto psi = lopsided_holes(loads.front().model.grid);
  const auto both = evaluated_under(loads, functions_of_both(), psi);
  ASSERT_TRUE(both) << both.failure().detail;
  const auto energy = std::make_shared<StrainEnergy<2>>();
  const auto uniformity = std::make_shared<UniformityL2<2>>(0.01);
  const auto drive = evaluated_under({loads[0]}, {objective<2>({{1, energy}})}, psi);
  const auto kerb = evaluated_under({loads[1]}, {objective<2>({{0.3, energy}, {50, uniformity}})}, psi);
  ASSERT_TRUE(drive && kerb);
  const FunctionValue &sum = both->evaluation.function("objective"),
                      &a = drive->evaluation.function("objective"),
                      &b = kerb->evaluation.function("objective");
  EXPECT_NEAR(sum.value, a.value + b.value, 1e-9 * sum.value);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(sum.by_position[i], a.by_position[i] + b.by_position[i], 1e-9 * sum.value);
  double largest = 0;
  for (const double g : sum.gradient) largest = std::max(largest, std::abs(g));
  for (size_t q = 0; q < sum.gradient.size(); ++q)
    EXPECT_NEAR(sum.gradient[q], a.gradient[q] + b.gradient[q], 1e-7 * largest);
  const auto value = [](const auto& values, const char* name) {
    const auto found = std::ranges::find_if(values, [&](const auto& v) { return v.name == name; });
    return found == values.end() ? -1 : found->value;
  };
  EXPECT_NEAR(value(both->evaluation.terms, "strain_energy in kerb"),
              value(kerb->evaluation.terms, "strain_energy"), 1e-9 * b.value);
  EXPECT_NEAR(value(both->evaluation.measures, "peak_pressure in kerb"),
              value(kerb->evaluation.measures, "peak_pressure"), 1);
}

// One load that is not its own mirror image is enough for all positions to be solved.
TEST(LoadCases, AWheelAndItsImageAgreeOnlyUnderSymmetricLoads) {
  LoadCases<2> loads = two_loads();
  loads[0].model.torque = 0;
  const auto psi = testing::paper_holes(loads.front().model.grid);
  const auto problem = RollingProblem<2>::create(loads.front().model);
  EXPECT_TRUE(problem->distinct_positions(psi).stand_for_images());
  EXPECT_FALSE(distinct_positions(*problem, loads, psi).stand_for_images());
  loads[1].model.horizontal_force = loads[1].model.distributed.body_force[1] = 0;
  EXPECT_TRUE(distinct_positions(*problem, loads, psi).stand_for_images());
}

Case case_of(const std::string& text) {
  const auto read = parse_case(text, "loads.toml");
  for (const auto& problem : read.problems) ADD_FAILURE() << problem.text();
  return read.value.value_or(Case{});
}

const std::string small_wheel = R"(
[material]
density = 1100
[load]
mass = 200
speed = 5
positions = 4
[contact]
friction = 0.5
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = 14
angular_cells = 128
tread_levels = 0
[optimizer]
rim_band = 0.02
tread_band = 0.02
)";

const std::string two_cases = small_wheel + R"(
[[load.case]]
name = "rolling"
[[load.case]]
name = "kerb"
weight = 0.25
mass = 500
torque = -30
speed = 0
[[constraint]]
quantity = "stiffness"
at_least = 1e6
[[constraint]]
quantity = "peak_pressure"
at_most = 4e6
over = "worst"
load_case = "kerb"
[[constraint]]
quantity = "volume_fraction"
at_most = 0.8
)";

TEST(LoadCases, OfACaseChangeOnlyGivenKeys) {
  const Case c = case_of(two_cases);
  const auto loads = load_cases<2>(c);
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_EQ(loads[0].name, "rolling");
  EXPECT_DOUBLE_EQ(loads[0].model.load, 200 * 9.81 / 0.12);
  EXPECT_DOUBLE_EQ(loads[0].model.distributed.angular_speed, 5 / 0.34);
  EXPECT_EQ(loads[0].model.torque, 0);
  EXPECT_DOUBLE_EQ(loads[1].model.load, 500 * 9.81 / 0.12);
  EXPECT_DOUBLE_EQ(loads[1].model.torque, -30 / 0.12);
  EXPECT_EQ(loads[1].model.distributed.angular_speed, 0);
  EXPECT_TRUE(loads[1].model.tread.observes_spin);
  EXPECT_DOUBLE_EQ(rolling_model<2>(c).load, loads[0].model.load);
  // A travel in place of the load, and a load in place of a travel.
  Case pressed = c;
  pressed.load.cases[1].force.reset();
  pressed.load.cases[1].travel = 2e-3;
  EXPECT_EQ(load_cases<2>(pressed)[1].model.travel, 2e-3);
  pressed = c;
  pressed.load.travel = 3e-3;
  EXPECT_EQ(load_cases<2>(pressed)[0].model.travel, 3e-3);
  EXPECT_FALSE(load_cases<2>(pressed)[1].model.travel);
  // What is written is read as the same case.
  EXPECT_EQ(case_of(to_toml(c)), c);
}

TEST(LoadCases, ConstraintsApplyToOneOrAll) {
  const auto study = make_study<2>(case_of(two_cases));
  ASSERT_TRUE(study) << study.failure().detail;
  std::vector<std::string> names;
  for (const auto& function : study->functions) names.push_back(function.name);
  EXPECT_EQ(names, (std::vector<std::string>{"objective", "volume", "stiffness", "stiffness in kerb",
                                             "peak_pressure worst in kerb", "volume_fraction"}));
  const auto evaluated = evaluate_of(*study)(study->initial, nullptr);
  ASSERT_TRUE(evaluated) << evaluated.failure().detail;
  const auto& e = evaluated->evaluation;
  const auto energy = [&](const char* name) {
    return std::ranges::find(e.terms, name, &TermValue::name)->value;
  };
  EXPECT_NEAR(e.function("objective").value, energy("strain_energy") + 0.25 * energy("strain_energy in kerb"),
              1e-12);
  // The contact stiffens under more load, and the first measure is that of the first load.
  EXPECT_GT(e.function("stiffness in kerb").value, 1.02 * e.function("stiffness").value);
  EXPECT_EQ(e.function("peak_pressure worst in kerb").unit, UnitKind::stress);
}

TEST(LoadCases, SingleOneEqualsThatLoad) {
  const auto value = [](const std::string& text) {
    const auto study = make_study<2>(case_of(text));
    return evaluate_of(*study)(study->initial, nullptr)->evaluation;
  };
  const auto alone = value(small_wheel), only = value(small_wheel + "[[load.case]]\nname = \"a\"\n");
  EXPECT_EQ(alone.function("objective").value, only.function("objective").value);
  EXPECT_EQ(alone.function("objective").gradient, only.function("objective").gradient);
}

TEST(LoadCases, RefuseImpossibleLoads) {
  const auto keys_of = [](const std::string& text) {
    std::vector<std::string> keys;
    for (const auto& problem : parse_case(text, "loads.toml").problems) keys.push_back(problem.key);
    return keys;
  };
  using Keys = std::vector<std::string>;
  // It slides under its own torque, and has the name of another one.
  EXPECT_EQ(keys_of(small_wheel + "[[load.case]]\nname = \"a\"\n[[load.case]]\nname = \"a\"\ntorque = 1e4\n"),
            (Keys{"load.case[2].name", "load.case[2].torque"}));
  EXPECT_EQ(keys_of(small_wheel + "[[load.case]]\nname = \"two words\"\n"), (Keys{"load.case[1].name"}));
  EXPECT_EQ(keys_of(small_wheel + "[[load.case]]\nname = \"a\"\nweight = 0\n"),
            (Keys{"load.case[1].weight"}));
  EXPECT_EQ(keys_of(small_wheel + "[[load.case]]\nname = \"a\"\nmass = 3\ntravel = 0.001\n"),
            (Keys{"load.case[1].travel"}));
  // A run-out is of a load, not of a travel, and a constraint names a load that is there.
  EXPECT_EQ(
      keys_of(small_wheel + "[[load.case]]\nname = \"a\"\n[[load.case]]\nname = \"b\"\ntravel = 0.001\n"
                            "[[constraint]]\nquantity = \"run_out\"\nat_most = 1e-4\n"
                            "[[constraint]]\nquantity = \"run_out\"\nat_most = 1e-4\nload_case = \"a\"\n"
                            "[[constraint]]\nquantity = \"run_out\"\nat_most = 1e-4\nload_case = \"c\"\n"),
      (Keys{"constraint[1].quantity", "constraint[3].load_case"}));
  // No mass, no pull.
  EXPECT_EQ(keys_of("[load]\nspeed = 9\n[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.04\n"),
            (Keys{"load.speed"}));
}

// A wheel whose stiffness is bounded under the load that is not minimized becomes feasible.
TEST(LoadCases, BoundUnderASeparateLoadIsKept) {
  Case c = case_of(two_cases);
  c.load.cases[1].weight = 0;
  c.constraints.resize(1);
  c.constraints[0].load_case = "kerb";
  c.optimizer.iterations = 12;
  const auto start = make_study<2>(c);
  const double stiffness =
      evaluate_of(*start)(start->initial, nullptr)->evaluation.function("stiffness in kerb").value;
  c.constraints[0].at_least = 1.05 * stiffness;
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  const auto outcome = optimize<2>(
      optimizer_of(*study), study->initial, [](const auto&, const auto&) {}, [] { return false; });
  ASSERT_TRUE(outcome.state);
  EXPECT_GE(outcome.state->evaluation.function("stiffness in kerb").value, (1 - 1e-3) * 1.05 * stiffness);
}

}  // namespace
}  // namespace wheelwright
