#include "wheelwright/run/study/bounded_functions.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/run/results/bounded_peaks.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/study.h"

using namespace wheelwright;

namespace {

Case small_case() {
  Case c;
  c.grid.radial_cells = 14;
  c.grid.angular_cells = 128;
  c.grid.tread_levels = 1;
  c.holes.rings = {{.count = 16, .center_radius = 0.27, .radius = 0.04}};
  c.load.positions = 4;
  return c;
}

Evaluation<2> evaluated(const Case& c) {
  const auto study = make_study<2>(c);
  EXPECT_TRUE(study);
  const auto shape = evaluate<2>(*study->solver, study->functions, study->initial);
  EXPECT_TRUE(shape);
  return shape->evaluation;
}

// The same quantity in its three forms: the mean and the largest of the single positions. Positions 1 and 3
// are mirror images and share a bound.
TEST(BoundedFunctions, AggregateMeanWorstOrEachPosition) {
  Case c = small_case();
  for (const auto over : {OverPositions::mean, OverPositions::worst, OverPositions::each})
    c.constraints.push_back({.quantity = built_in("stiffness"), .at_most = 1e9, .over = over});
  const auto evaluation = evaluated(c);
  std::vector<std::string> names;
  for (const auto& function : evaluation.functions) names.push_back(function.name);
  ASSERT_EQ(names, (std::vector<std::string>{"objective", "volume", "stiffness", "stiffness worst",
                                             "stiffness at 0", "stiffness at 1", "stiffness at 2"}));
  const auto value = [&](const char* name) { return evaluation.function(name).value; };
  const double a = value("stiffness at 0"), b = value("stiffness at 1"), d = value("stiffness at 2");
  EXPECT_NE(a, d);
  EXPECT_NEAR(value("stiffness worst"), std::max({a, b, d}), 1e-9 * a);
  // The mean force, which is the same in all positions, by the mean travel.
  EXPECT_NEAR(value("stiffness"), 4 / (1 / a + 2 / b + 1 / d), 1e-9 * a);
  EXPECT_EQ(bound_states(evaluation, {}).size(), 5u);
  EXPECT_EQ(evaluation.function("stiffness at 1").unit, UnitKind::stiffness);
}

TEST(BoundedFunctions, CoverEveryPositionOfAnAsymmetricWheel) {
  Case c = small_case();
  c.contact.friction = 0.3;
  c.load.torque = 50;
  c.constraints = {{.quantity = built_in("strain_energy"), .at_most = 10, .over = OverPositions::each}};
  EXPECT_EQ(evaluated(c).functions.size(), 2u + 4u);
}

// A lighter wheel of the same stiffness, to begin with one that is too soft by two percent.
TEST(BoundedFunctions, AreShownOnTheWholeWidthInTheUnitsOfTables) {
  Case c = small_case();
  c.wheel.width = 0.04;
  c.load.force = 1000;
  c.constraints = {{.quantity = built_in("stiffness"), .at_least = 600e3 / c.wheel.width}};
  EXPECT_NE(derived_report(c).find("stiffness at least 600 N/mm"), std::string::npos);
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  const auto bounds = bound_states(evaluated(c), {});
  ASSERT_EQ(bounds.size(), 1u);
  double value = 0, limit = 0;
  const std::string shown = text(bounds[0], study->grid());
  ASSERT_EQ(std::sscanf(shown.c_str(), "stiffness = %lf N/mm, is at least %lf N/mm", &value, &limit), 2)
      << shown;
  EXPECT_NEAR(value, bounds[0].value * 0.04 * 1e-3, 1e-5 * value);
  EXPECT_NEAR(limit, 600, 1e-9);
}

TEST(BoundedFunctions, NameTheToleranceWithoutWhichABoundIsNotKept) {
  const auto study = make_study<2>(small_case());
  ASSERT_TRUE(study);
  const auto state = [](double bound, double violation) {
    return BoundState{.name = "mean_travel",
                      .value = bound + violation * (bound == 0 ? 1 : bound),
                      .bound = bound,
                      .relation = '<',
                      .multiplier = 0,
                      .violation = violation,
                      .unit = UnitKind::length};
  };
  const auto names_it = [&](const BoundState& bound) {
    return text(bound, study->grid()).find("within 0.1 %") != std::string::npos;
  };
  for (const double violation : {2e-6, 5e-4, 1e-3}) {
    EXPECT_EQ(state(2e-3, violation).kept_within(), feasible_violation) << violation;
    EXPECT_TRUE(names_it(state(2e-3, violation))) << violation;
  }
  for (const double violation : {0.0, 1e-9, 1.01e-3}) {
    EXPECT_EQ(state(2e-3, violation).kept_within(), 0) << violation;
    EXPECT_FALSE(names_it(state(2e-3, violation))) << violation;
  }
  EXPECT_EQ(state(0, 5e-4).kept_within(), 0);  // of what?
}

// Peaks may be larger between the positions; what is a mean or does not depend on the load has nothing
// between.
TEST(BoundedFunctions, OnPeaksNameTheNumberOfTheirPositions) {
  Case c = small_case();
  c.load.positions = 12;
  c.constraints = {{.quantity = built_in("stiffness"), .at_least = 1},
                   {.quantity = built_in("mass"), .at_most = 1},
                   {.quantity = built_in("travel"), .at_most = 1}};
  EXPECT_EQ(bounded_peaks(c), "");
  for (const Constraint& peak :
       {Constraint{.quantity = built_in("peak_von_mises"), .at_most = 1},
        Constraint{.quantity = built_in("travel"), .at_most = 1, .over = OverPositions::worst},
        Constraint{.quantity = built_in("travel"), .at_most = 1, .over = OverPositions::each}}) {
    Case with_peak = c;
    with_peak.constraints.push_back(peak);
    const std::string told = bounded_peaks(with_peak);
    EXPECT_NE(told.find(name(peak.quantity)), std::string::npos) << told;
    EXPECT_NE(told.find(" 12 "), std::string::npos) << told;
    EXPECT_EQ(told.find("stiffness"), std::string::npos) << told;
  }
}

TEST(BoundedFunctions, PermitALighterWheel) {
  Case c = small_case();
  c.constraints = {{.quantity = built_in("stiffness"), .at_least = 1}};
  c.constraints[0].at_least = 1.02 * evaluated(c).function("stiffness").value;
  c.objective.minimize = built_in("volume_fraction");
  c.optimizer.iterations = 30;
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  const auto outcome = optimize<2>(
      optimizer_of(*study), study->initial, [](const auto&, const auto&) {}, [] { return false; });
  ASSERT_TRUE(outcome.state);
  const auto bounds = bound_states(outcome.state->evaluation, outcome.state->memory.multipliers);
  ASSERT_EQ(bounds.size(), 1u);
  EXPECT_TRUE(bounds[0].is_kept()) << bounds[0].value;
  EXPECT_GT(bounds[0].multiplier, 0);
  EXPECT_LT(outcome.state->evaluation.function("objective").value,
            0.99 * evaluated(c).function("objective").value);
  EXPECT_NEAR(outcome.state->evaluation.function("objective").value,
              volume_fraction(study->grid(), outcome.state->measure), 1e-9);
}

}  // namespace
