#include <nlohmann/json.hpp>

#include "tests/run_support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/design/explore/report_designs.h"
#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/run/session/run.h"

namespace wheelwright::testing {
namespace {

/// One shape of the small wheel, rolling and on a kerb, with more sections.
std::string two_loads(const std::string& more = "") {
  return small_case(1, R"(
[contact]
friction = 0.5
[[load.case]]
name = "rolling"
mass = 200
[[load.case]]
name = "kerb"
mass = 500
torque = 50
weight = 0.5
)" + more);
}

class LoadCaseResults : public TemporaryFolder {
 protected:
  RunResult<2> run(const Case& c, const std::string& name) {
    auto run = wheelwright::Run<2>::begin(c, folder() / name);
    CommandQueue commands;
    return run->execute(commands);
  }
  Case case_of(const std::string& text) {
    const auto read = parse_case(text, "case.toml");
    for (const auto& problem : read.problems) ADD_FAILURE() << problem.text();
    return *read.value;
  }
  nlohmann::json summary(const std::string& name) {
    return nlohmann::json::parse(content(folder() / name / "summary.json"));
  }
};

/// Every number under the kerb is that of the same wheel with only the kerb's load.
TEST_F(LoadCaseResults, AreThoseOfEachLoadAlone) {
  Case both = case_of(two_loads());
  both.optimizer.iterations = 0;
  Case kerb = single_load_cases(both)[1];
  run(both, "both");
  run(kerb, "kerb");
  const auto before = summary("both")["before"];
  EXPECT_EQ(before["load_case"], "rolling");
  const auto in_kerb = before["load_cases"]["kerb"], alone = summary("kerb")["before"];
  int compared = 0;
  for (const WheelNumber<2>& number : wheel_numbers<2>()) {
    EXPECT_EQ(!number.is_of_shape && alone.contains(number.key), in_kerb.contains(number.key)) << number.key;
    if (!in_kerb.contains(number.key)) continue;
    const double expected = alone[number.key];
    EXPECT_NEAR(in_kerb[number.key].get<double>(), expected, 1e-6 * std::abs(expected)) << number.key;
    ++compared;
  }
  EXPECT_GT(compared, 8);
  EXPECT_NEAR(in_kerb["load_N"].get<double>() / before["load_N"].get<double>(), 2.5, 1e-9);
}

TEST_F(LoadCaseResults, AreInTheTablePicturesAndExpectations) {
  const Case c = case_of(two_loads(R"(
[[expect]]
quantity = "stiffness"
value = 1
load_case = "kerb"
[[expect]]
quantity = "peak_pressure"
value = 1
load_case = "kerb"
[[expect]]
quantity = "mean_travel"
value = 1
iteration = 0
load_case = "kerb"
[[expect]]
quantity = "mean_travel"
value = 1
iteration = 0
)"));
  const RunResult<2> result = run(c, "run");
  ASSERT_TRUE(result.summary);
  const auto now = summary("run");
  const auto kerb = now["after"]["load_cases"]["kerb"];
  ASSERT_EQ(result.findings.size(), 4u);
  for (const Finding& finding : result.findings) ASSERT_TRUE(finding.found) << finding.text();
  const double width = c.wheel.width;
  EXPECT_NEAR(*result.findings[0].found * width, kerb["stiffness_N_per_m"],
              0.02 * *result.findings[0].found * width);
  EXPECT_NEAR(*result.findings[1].found, kerb["peak_pressure_Pa"], 0.1 * *result.findings[1].found);
  EXPECT_NEAR(*result.findings[2].found, now["before"]["load_cases"]["kerb"]["mean_travel_m"],
              0.02 * *result.findings[2].found);
  EXPECT_NEAR(*result.findings[3].found, now["before"]["mean_travel_m"], 0.02 * *result.findings[3].found);
  EXPECT_GT(*result.findings[2].found, 1.5 * *result.findings[3].found);

  const auto rows = compared_rows<2>({&result.summary->before.wheel, &result.summary->after.wheel});
  const auto row = std::ranges::find(rows, "stiffness in kerb [N/mm]", &ComparedRow::label);
  ASSERT_NE(row, rows.end());
  EXPECT_NEAR(**row->values[1], 1e-3 * kerb["stiffness_N_per_m"].get<double>(), 1e-9);
  EXPECT_EQ(std::ranges::find(rows, "volume of the ring in kerb [%]", &ComparedRow::label), rows.end());

  for (const char* picture : {"kerb_stress.svg", "kerb_stress_contact.svg", "kerb_displacement.svg"})
    EXPECT_TRUE(fs::exists(folder() / "run" / "load_cases" / picture)) << picture;
  EXPECT_NE(content(folder() / "run" / "load_cases" / "kerb_stress.svg"),
            content(folder() / "run" / "stress.svg"));
}

TEST_F(LoadCaseResults, OfDesignsHaveSeparateColumns) {
  RankedDesign one;
  one.design = {"001", "start", case_of(two_loads()), {}};
  one.result = {Progression::full, "converged", 3};
  one.front = 1;
  one.result.numbers = {
      {"run_out_m", 2e-6}, {key_in_case("run_out_m", "kerb"), 5e-6}, {"volume_fraction", 0.6}};
  const auto table =
      split(designs_table({one}, {*find_quantity("run_out"), *find_quantity("volume")}, 5), '\n');
  EXPECT_NE(table[0].find("run_out in kerb [um]"), std::string::npos);
  EXPECT_EQ(table[0].find("volume in kerb"), std::string::npos);
  EXPECT_TRUE(table[1].ends_with(" 5")) << table[1];
  const auto csv = split(designs_csv({one}), '\n');
  const auto names = split(csv[0], ','), cells = split(csv[1], ',');
  const auto column = std::ranges::find(names, "run_out_m in kerb") - names.begin();
  ASSERT_LT(column, std::ssize(cells));
  EXPECT_EQ(std::stod(cells[column]), 5e-6);
  const auto json = nlohmann::json::parse(designs_json({one}, {*find_quantity("run_out")}));
  EXPECT_EQ(json["designs"][0]["numbers"]["run_out_m in kerb"], 5e-6);
}

TEST_F(LoadCaseResults, AreRefusedForUnknownLoads) {
  const auto read = parse_case(
      two_loads("[[expect]]\nquantity = \"run_out\"\nvalue = 1\nload_case = \"kerbs\"\n"), "case.toml");
  ASSERT_EQ(read.problems.size(), 1u);
  EXPECT_NE(read.problems[0].text().find("expect[1].load_case"), std::string::npos)
      << read.problems[0].text();
}

}  // namespace
}  // namespace wheelwright::testing
