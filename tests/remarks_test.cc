#include "wheelwright/run/results/remarks.h"

#include "tests/run_support.h"
#include "wheelwright/case/read.h"

namespace wheelwright::testing {
namespace {

Case case_of(const std::string& text) {
  const CaseResult result = parse_case(text, "case.toml");
  EXPECT_TRUE(result.value) << result.problems.front().text();
  return *result.value;
}

const JudgedWheel caster{.load = 1000,
                         .mean_travel = 1e-3,
                         .stiffness = 1e6,
                         .run_out = 0.0996e-3,
                         .force_variation = 90,
                         .peak_pressure = 2e6,
                         .peak_von_mises = 3e6,
                         .largest_strain = 0.01};

std::vector<std::string> keys(const std::vector<Remark>& remarks) {
  std::vector<std::string> result;
  for (const Remark& remark : remarks) result.push_back(remark.key);
  return result;
}

using Keys = std::vector<std::string>;

TEST(Remarks, ReportNumbersWorseByATenth) {
  const Case c = case_of(small_wheel);
  EXPECT_TRUE(remarks(c, "", caster, caster).empty());
  const auto changed = [](double factor) {
    JudgedWheel wheel = caster;
    for (const auto member :
         {&JudgedWheel::stiffness, &JudgedWheel::run_out, &JudgedWheel::force_variation,
          &JudgedWheel::peak_pressure, &JudgedWheel::peak_von_mises, &JudgedWheel::largest_strain})
      wheel.*member = factor * *(wheel.*member);
    return wheel;
  };
  EXPECT_EQ(
      keys(remarks(c, "", caster, changed(1.12))),
      (Keys{"run_out_m", "force_variation_N", "peak_pressure_Pa", "peak_von_mises_Pa", "largest_strain"}));
  EXPECT_EQ(keys(remarks(c, "", caster, changed(0.88))), Keys{"stiffness_N_per_m"});
  EXPECT_TRUE(remarks(c, "", caster, changed(1.09)).empty());
  EXPECT_TRUE(remarks(c, "", caster, changed(0.91)).empty());
}

TEST(Remarks, IgnoreSmallVariations) {
  JudgedWheel even = caster;
  even.run_out = 1e-9;
  even.force_variation = 1e-3;
  JudgedWheel uneven = even;
  uneven.run_out = 0.9e-5;
  uneven.force_variation = 9;
  EXPECT_TRUE(remarks(case_of(small_wheel), "", even, uneven).empty());
  uneven.run_out = 1.1e-5;
  EXPECT_EQ(keys(remarks(case_of(small_wheel), "", even, uneven)), Keys{"run_out_m"});
}

TEST(Remarks, IgnoreUnknownAndBoundedNumbers) {
  JudgedWheel worse = caster;
  worse.run_out = 0.23e-3;
  EXPECT_EQ(keys(remarks(case_of(small_wheel), "", caster, worse)), Keys{"run_out_m"});
  const auto with = [](const std::string& bound) {
    return case_of(small_wheel + "[[constraint]]\n" + bound);
  };
  EXPECT_TRUE(remarks(with("quantity = \"run_out\"\nat_most = 0.0003"), "", caster, worse).empty());
  EXPECT_EQ(remarks(with("quantity = \"run_out\"\nat_least = 0.00001"), "", caster, worse).size(), 1u);
  EXPECT_EQ(remarks(with("quantity = \"stiffness\"\nat_least = 1e5"), "", caster, worse).size(), 1u);
  JudgedWheel softer = caster;
  softer.stiffness = 0.5 * *caster.stiffness;
  EXPECT_EQ(remarks(case_of(small_wheel), "", caster, softer).size(), 1u);
  EXPECT_TRUE(remarks(with("quantity = \"mean_travel\"\nat_most = 0.003"), "", caster, softer).empty());
  JudgedWheel unknown = worse;
  unknown.run_out.reset();
  EXPECT_TRUE(remarks(case_of(small_wheel), "", caster, unknown).empty());
  EXPECT_TRUE(remarks(case_of(small_wheel), "", unknown, worse).empty());
}

const std::string cases_of_loads =
    "[[load.case]]\nname = \"straight\"\n[[load.case]]\nname = \"kerb\"\nmass = 400\n";
const std::string two_loads = small_wheel + cases_of_loads;
const std::string held_travel = [] {
  std::string text = small_wheel;
  return text.replace(text.find("positions = 2"), 13, "positions = 2\ntravel = 0.001");
}();

/// What is suggested is a case again, whose bound is the value from before, or a little looser.
TEST(Remarks, SuggestBoundsThatTheProgramAccepts) {
  JudgedWheel worse = caster;
  worse.stiffness = 0.5 * *caster.stiffness;
  for (const auto member : {&JudgedWheel::run_out, &JudgedWheel::force_variation, &JudgedWheel::peak_pressure,
                            &JudgedWheel::peak_von_mises, &JudgedWheel::largest_strain})
    worse.*member = 3 * *(caster.*member);
  for (const auto& [text, load_case] :
       {std::pair{small_wheel, std::string()}, {two_loads, "kerb"}, {held_travel, ""}}) {
    const Case c = case_of(text);
    const auto found = remarks(c, load_case, caster, worse);
    EXPECT_EQ(found.size(), 6u);
    int bounds = 0;
    for (const Remark& remark : found) {
      if (remark.constraint.empty()) continue;
      ++bounds;
      const Case bounded = case_of(text + remark.constraint + "\n");
      ASSERT_EQ(bounded.constraints.size(), 1u) << remark.constraint;
      const Constraint& bound = bounded.constraints.front();
      EXPECT_EQ(bound.load_case, load_case);
      const double factor =
          bound.quantity == built_in("stiffness") || bound.quantity == built_in("force_variation")
              ? c.wheel.width
              : 1;
      const double value = factor * bound.at_least.value_or(bound.at_most.value_or(0));
      const double side = bound.at_least ? -1 : 1;
      EXPECT_GE(side * value, (side - 1e-12) * remark.before) << remark.constraint;
      EXPECT_NEAR(value, remark.before, 0.01 * remark.before) << remark.constraint;
      EXPECT_TRUE(remarks(bounded, load_case, caster, worse).size() < found.size());
    }
    EXPECT_EQ(bounds, 5);  // one for either variation
  }
}

// The force varies less where the run-out is bounded, but a bound on a run-out that has fallen changes
// nothing.
TEST(Remarks, SuggestOnlyBoundsThatTheWheelBreaks) {
  JudgedWheel worse = caster;
  worse.force_variation = 3 * *caster.force_variation;
  worse.run_out = 0.9 * *caster.run_out;
  const auto found = remarks(case_of(small_wheel), "", caster, worse);
  ASSERT_EQ(keys(found), Keys{"force_variation_N"});
  EXPECT_EQ(found.front().constraint, "");
  worse.run_out = 1.01 * *caster.run_out;
  EXPECT_NE(remarks(case_of(small_wheel), "", caster, worse).front().constraint, "");
}

TEST(Remarks, SuggestNoExistingBound) {
  JudgedWheel worse = caster;
  worse.force_variation = 3 * *caster.force_variation;
  const auto without = remarks(case_of(small_wheel), "", caster, worse);
  ASSERT_EQ(without.size(), 1u);
  EXPECT_NE(without[0].constraint.find("run_out"),
            std::string::npos);  // a force's variation follows the run-out
  const auto with = remarks(case_of(small_wheel + without[0].constraint + "\n"), "", caster, worse);
  ASSERT_EQ(with.size(), 1u);
  EXPECT_TRUE(with[0].constraint.empty()) << with[0].constraint;
}

TEST(Remarks, SuggestNoBoundToSteepestDescent) {
  JudgedWheel worse = caster;
  worse.run_out = 3 * *caster.run_out;
  const auto found = remarks(case_of(small_wheel + "method = \"descent\"\n"), "", caster, worse);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].constraint.empty());
}

}  // namespace
}  // namespace wheelwright::testing
