// The damage of several load cases by Miner's rule: of points by hand, of wheels, of a whole case file.

#include "wheelwright/quantities/analysis/fatigue_damage.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/mechanics/elasticity/miners_rule.h"
#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/output/report/fatigue_field.h"
#include "wheelwright/output/report/numbers_json.h"
#include "wheelwright/output/report/rolling_report.h"
#include "wheelwright/output/report/turn_peaks.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

constexpr FatigueStrength hand_made{
    .measure = FatigueMeasure::principal_strain, .limit = 0.02, .cycles = 1e6, .exponent = 4};

TEST(MinersRule, AddsTheDamageOfLoadCases) {
  // Three quarters of the way at the limit, one quarter at twice the limit, where the life is 2^-4 as long.
  const double damage =
      damage_per_turn(hand_made, std::vector<double>{1, 2}, std::vector<double>{0.75, 0.25});
  EXPECT_NEAR(damage, (0.75 + 0.25 * 16) / 1e6, 1e-20);
  EXPECT_NEAR(equivalent_utilization(hand_made, damage), std::pow(4.75, 0.25), 1e-14);
  EXPECT_EQ(damage_per_turn(hand_made, std::vector<double>{0, 0}, std::vector<double>{0.5, 0.5}), 0);
}

// Two points are each the worst of one load case, and the third one, of none, lasts least.
TEST(MinersRule, ThePointOfMostDamageMayBeTheWorstOfNoLoadCase) {
  const std::vector<Vec<3>> places{{0.21, 0, 0}, {0.22, 0, 0}, {0.23, 0, 0}};
  const UtilizedPoints points[] = {{places, {1, 0.1, 0.9}}, {places, {0.1, 1, 0.9}}};
  const auto worst = most_damaged(hand_made, points, std::vector<double>{0.5, 0.5});
  EXPECT_EQ(worst.place[0], 0.23);
  EXPECT_NEAR(worst.utilization, 0.9, 1e-14);
  EXPECT_NEAR(*worst.life, 1e6 / 0.6561, 1e-6);
  EXPECT_NEAR(worst.by_case[0], 0.5, 1e-14);
  // One that is driven nearly all the way decides.
  EXPECT_EQ(most_damaged(hand_made, points, std::vector<double>{0.99, 0.01}).place[0], 0.21);
  const UtilizedPoints unloaded[] = {{{{0.21, 0, 0}}, {0}}, {{{0.21, 0, 0}}, {0}}};
  EXPECT_TRUE(std::isinf(*most_damaged(hand_made, unloaded, std::vector<double>{0.5, 0.5}).life));
}

std::shared_ptr<const IsotropicLaw<2>> tired(FatigueMeasure measure, double limit, double exponent) {
  Material material{200e6, 0.35};
  material.fatigue = FatigueStrength{.measure = measure, .limit = limit, .cycles = 1e6, .exponent = exponent};
  return std::make_shared<const IsotropicLaw<2>>(material);
}

/// A wheel of two layers under two loads, one of which drives it.
LoadCases<2> two_loads(double share) {
  RollingModel<2> rolling = testing::paper_model(14, 192);
  rolling.n_positions = 2;
  rolling.contact.friction = 0.5;
  rolling.materials = Materials<2>({{0.27, tired(FatigueMeasure::crossland, 2e6, 5), "core"},
                                    {0.34, tired(FatigueMeasure::strain_energy, 2e4, 3), "tyre"}});
  RollingModel<2> driving = rolling;
  driving.load *= 1.2;
  driving.torque = 250;
  return {{"rolling", rolling, share}, {"driving", driving, 1 - share}};
}

struct Solved {
  std::shared_ptr<const RollingProblem<2>> problem;
  LevelSet<2> psi;
  StatesOfCases<2> states;
};

Solved solved(const LoadCases<2>& cases, const LevelSet<2>& psi, bool distinct = false) {
  auto problem = RollingProblem<2>::create(cases.front().model);
  if (!problem) throw std::runtime_error(problem.failure().detail);
  auto shared = std::make_shared<const RollingProblem<2>>(*std::move(problem));
  auto states = states_of_cases<2>(*shared, cases, {psi},
                                   distinct ? shared->distinct_positions(psi) : shared->all_positions(), {});
  if (!states) throw std::runtime_error(states.failure().detail);
  return {std::move(shared), psi, *std::move(states)};
}

FatigueDamage damage(const Solved& wheel, LoadCases<2> cases, const std::vector<double>& shares) {
  for (std::size_t k = 0; k < shares.size(); ++k) cases[k].distance_share = shares[k];
  return **fatigue_damage<2>(*wheel.problem, wheel.psi, *wheel.states.front(), cases, Interrupt());
}

FatigueDamage damage(const Solved& wheel, const LoadCases<2>& cases) {
  return damage(wheel, cases, distance_shares(cases));
}

FatigueResults results(const Solved& wheel, int load_case) {
  return **fatigue_results<2>(*wheel.problem, wheel.psi, *wheel.states[load_case]);
}

/// All of the distance under one load case is that load case.
TEST(FatigueDamage, OfOneLoadCaseIsThatOfItsTurns) {
  const LoadCases<2> cases = two_loads(0.5);
  const Solved wheel = solved(cases, testing::generic_hole(cases.front().model.grid));
  for (const int only : {0, 1}) {
    const FatigueDamage found = damage(wheel, cases, {1.0 - only, 1.0 * only});
    const FatigueResults expected = results(wheel, only);
    const auto expect_same = [&](const FatigueDamage::Worst& a, const FatigueResults::Worst& b) {
      EXPECT_EQ(a.place, b.place);
      EXPECT_NEAR(a.utilization, b.utilization, 1e-14 * b.utilization);
      EXPECT_NEAR(*a.life, *b.life, 1e-15 * *b.life);
      EXPECT_EQ(a.by_case[only], 1);
      EXPECT_EQ(a.by_case[1 - only], 0);
    };
    expect_same(found.worst, expected.worst);
    ASSERT_EQ(found.by_layer.size(), 2);
    for (const int layer : {0, 1}) expect_same(found.by_layer[layer], expected.by_layer[layer]);
  }
}

/// The worst point is at least as bad as under the share of any one load case, at most as bad as if the
/// worst points of all load cases were one; its parts are those of the load cases there.
TEST(FatigueDamage, LiesBetweenThoseOfSeparateAndOfCommonPlaces) {
  const LoadCases<2> cases = two_loads(0.7);
  const Solved wheel = solved(cases, testing::generic_hole(cases.front().model.grid));
  const std::vector<double> shares = distance_shares(cases);
  const FatigueDamage found = damage(wheel, cases);
  for (const int layer : {0, 1}) {
    const FatigueDamage::Worst& worst = found.by_layer[layer];
    double least = 0, most = 0, parts = 0;
    for (const int k : {0, 1}) {
      const double by_itself = shares[k] / *results(wheel, k).by_layer[layer].life;
      least = std::max(least, by_itself);
      most += by_itself;
      parts += worst.by_case[k];
    }
    EXPECT_GE(1 / *worst.life, (1 - 1e-12) * least);
    EXPECT_LE(1 / *worst.life, (1 + 1e-12) * most);
    EXPECT_NEAR(parts, 1, 1e-12);
  }
  EXPECT_EQ(*found.worst.life, std::min(*found.by_layer[0].life, *found.by_layer[1].life));
}

/// With the contact held by bonding, twice the load doubles stresses everywhere: its turns do 2^k times the
/// damage at every point, and energies 4^k.
TEST(FatigueDamage, OfTwiceTheLoadIsThatOfTheCurve) {
  LoadCases<2> cases = two_loads(0.7);
  for (auto& load_case : cases) {
    load_case.model = cases.front().model;
    load_case.model.contact = {.method = ContactMethod::nitsche, .counterpart = Counterpart::ring};
    load_case.model.contact_points = 3;
  }
  cases[1].model.load *= 2;
  const Solved wheel = solved(cases, testing::generic_hole(cases.front().model.grid));
  const FatigueDamage found = damage(wheel, cases);
  const FatigueResults first = results(wheel, 0);
  for (const int layer : {0, 1}) {
    const double factor = layer == 0 ? std::pow(2, 5) : std::pow(4, 3),
                 expected = *first.by_layer[layer].life / (0.7 + 0.3 * factor);
    EXPECT_EQ(found.by_layer[layer].place, first.by_layer[layer].place);
    EXPECT_NEAR(*found.by_layer[layer].life, expected, 1e-9 * expected);
    EXPECT_NEAR(found.by_layer[layer].by_case[1], 0.3 * factor / (0.7 + 0.3 * factor), 1e-9);
  }
}

TEST(FatigueDamage, OfASymmetricWheelNeedsAllPositions) {
  LoadCases<2> cases = two_loads(0.7);
  cases[1].model.torque = 0;
  for (auto& load_case : cases) load_case.model.n_positions = 4;
  const auto psi = testing::paper_holes(cases.front().model.grid);
  const Solved half = solved(cases, psi, true), all = solved(cases, psi);
  ASSERT_TRUE(half.states.front()->positions().stand_for_images());
  const double expected = damage(all, cases).worst.utilization;
  EXPECT_NEAR(damage(half, cases).worst.utilization, expected, 1e-9 * expected);
}

/// The picture shows the equivalent utilization: with shares 1 and 0 that of the first load case, and nowhere
/// more than the worst of both.
TEST(FatigueDamage, IsPicturedAsEquivalentUtilization) {
  LoadCases<2> cases = two_loads(1);
  const Solved wheel = solved(cases, testing::generic_hole(cases.front().model.grid));
  const State<2>& first = *wheel.states.front();
  const auto values = [&](const std::optional<NamedField>& field) { return field->field.values; };
  const auto rolling = values(fatigue_field<2>(*wheel.problem, first)),
             driving = values(fatigue_field<2>(*wheel.problem, *wheel.states[1])),
             only_first = values(fatigue_field<2>(*wheel.problem, first, cases));
  cases[0].distance_share = cases[1].distance_share = 0.5;
  const auto both = values(fatigue_field<2>(*wheel.problem, first, cases));
  for (std::size_t i = 0; i < rolling.size(); ++i) {
    if (std::isnan(rolling[i])) continue;
    EXPECT_NEAR(only_first[i], rolling[i], 1e-13 * rolling[i]);
    // Means over cells of powers lie between.
    EXPECT_LE(both[i], 1.05 * std::max(rolling[i], driving[i]));
    EXPECT_GE(both[i], 0.7 * std::min(rolling[i], driving[i]));
  }
}

constexpr const char* case_with_shares = R"(
[wheel]
inner_radius = 0.05
outer_radius = 0.1
width = 0.04
sectors = 8
[material]
youngs_modulus = 200e6
poissons_ratio = 0.35
fatigue_measure = "crossland"
fatigue_limit = 2e6
fatigue_pressure_factor = 0.3
fatigue_exponent = 5
[[material.layer]]
name = "tyre"
inner_radius = 0.088
youngs_modulus = 40e6
poissons_ratio = 0.45
fatigue_measure = "principal_strain"
fatigue_strain = 0.2
{}
[load]
force = 800
positions = 2
[[load.case]]
name = "rolling"
{}
[[load.case]]
name = "heavy"
force = 1600
{}
[[holes.ring]]
count = 8
center_radius = 0.07
radius = 0.012
[grid]
radial_cells = 12
angular_cells = 96
[optimizer]
rim_band = 0.006
tread_band = 0.009
)";

CaseResult case_of(const std::string& of_tyre, const std::string& first, const std::string& second) {
  return parse_case(fmt::format(fmt::runtime(case_with_shares), of_tyre, first, second), "shares.toml");
}

TEST(FatigueDamage, NeedsSharesOfAllThatSumToOneAndLives) {
  const std::string exponent = "fatigue_exponent = 3\n";
  const auto problems = [&](const std::string& of_tyre, const std::string& first, const std::string& second) {
    std::vector<std::string> keys;
    for (const Diagnostic& problem : case_of(of_tyre, first, second).problems) keys.push_back(problem.key);
    return keys;
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(problems(exponent, "", ""), Keys{});
  EXPECT_EQ(problems(exponent, "distance_share = 0.3333\n", "distance_share = 0.6667\n"), Keys{});
  EXPECT_EQ(problems(exponent, "distance_share = 1\n", "distance_share = 0\n"), Keys{});
  EXPECT_EQ(problems(exponent, "distance_share = 0.5\n", "distance_share = 0.6\n"),
            Keys{"load.case[1].distance_share"});
  EXPECT_EQ(problems(exponent, "", "distance_share = 1\n"), Keys{"load.case[2].distance_share"});
  EXPECT_EQ(problems(exponent, "distance_share = 1.2\n", "distance_share = -0.2\n").size(), 2);
  EXPECT_EQ(problems("", "distance_share = 0.5\n", "distance_share = 0.5\n"),
            Keys{"load.case[1].distance_share"});
}

/// The numbers of a case file, in every form in which people see them.
TEST(FatigueDamage, OfACaseIsInTablesAndFiles) {
  const auto read = case_of("fatigue_exponent = 3\n", "distance_share = 0.8\n", "distance_share = 0.2\n");
  ASSERT_TRUE(read.value) << read.problems.front().text();
  const Case& c = *read.value;
  EXPECT_NE(derived_report(c).find("heavy, weight 1, 20 % of the distance"), std::string::npos);
  const auto cases = load_cases<2>(c);
  const auto solver = make_solver(rolling_model<2>(c));
  const auto psi = initial_shape<2>(c);
  const SolvedStates<2> states = (*solver)->states(psi, (*solver)->all_positions(), Interrupt());
  ASSERT_TRUE(states) << states.failure().detail;
  const auto wheel = described_solution<2>(**solver, psi, 0.5, states, cases);
  ASSERT_TRUE(wheel.damage && *wheel.damage);
  const FatigueDamage& found = **wheel.damage;

  nlohmann::ordered_json json;
  add_numbers(wheel, json);
  const auto distance = [&](double turns) { return turns * 2 * std::numbers::pi * 0.1; };
  const double life = distance(*found.worst.life), of_tyre = distance(*found.by_layer[1].life);
  EXPECT_NEAR(json["fatigue_life_m in all load cases"].get<double>(), life, 1e-9 * life);
  EXPECT_NEAR(json["fatigue_life_m of tyre in all load cases"].get<double>(), of_tyre, 1e-9 * of_tyre);
  EXPECT_NEAR(json["fatigue_utilization of tyre in all load cases"].get<double>(),
              found.by_layer[1].utilization, 1e-12);
  // Of single load cases, whose damages by their shares bound that of all.
  double bound = 0;
  for (const auto& [share, of_case] : {std::pair{0.8, json}, std::pair{0.2, json["load_cases"]["heavy"]}}) {
    const auto& fatigue = of_case["fatigue_life_m of tyre"];
    ASSERT_TRUE(fatigue.is_number());
    EXPECT_TRUE(of_case["fatigue_utilization of tyre"].is_number());
    bound += share / fatigue.get<double>();
  }
  EXPECT_GE(of_tyre, (1 - 1e-12) / bound);
  EXPECT_FALSE(json["load_cases"]["heavy"].contains("fatigue_life_m in all load cases"));

  const std::string table = comparison_table({"wheel"}, compared_rows<2>({&wheel}));
  for (const char* row : {"fatigue life in all load cases", "fatigue utilization of tyre in all load cases",
                          "fatigue life of tyre in heavy"})
    EXPECT_NE(table.find(row), std::string::npos) << row;

  // Pictures mark the same place and number.
  const auto marked = turn_peaks(wheel);
  EXPECT_EQ(marked.fatigue->value, found.worst.utilization);
  EXPECT_NEAR(std::hypot(marked.fatigue->place[0], marked.fatigue->place[1]), found.worst.place[0], 1e-12);
  EXPECT_EQ(turn_peaks(wheel.others[0]).fatigue->value,
            (*wheel.others[0].loaded->fatigue)->worst.utilization);
  EXPECT_FALSE(marked.temperature);

  const auto of_shape = shape_json<2>({0, 1.0, wheel}, "");
  EXPECT_EQ(of_shape["damage_by_load_case of tyre"]["heavy"], found.by_layer[1].by_case[1]);
  EXPECT_EQ(of_shape["fatigue_place of tyre in all load cases"]["radius_m"], found.by_layer[1].place[0]);
}

/// The report of analyze names the places of all layers, in millimetres and degrees.
TEST(FatigueDamage, IsInTheReportOfAnalyze) {
  const LoadCases<2> cases = two_loads(0.7);
  const Solved wheel = solved(cases, testing::generic_hole(cases.front().model.grid));
  RollingReport report{.title = "wheel",
                       .width = 0.1,
                       .n_sectors = 16,
                       .analysis = rolling_analysis<2>(*wheel.problem, *wheel.states.front())};
  report.outer_radius = 0.34;
  report.fatigue = results(wheel, 0);
  report.damage = damage(wheel, cases);
  report.load_cases = {"rolling", "driving"};
  const std::string table = rolling_table(report);
  const FatigueDamage::Worst& tyre = (*report.damage)->by_layer[1];
  const std::string degrees = fmt::format("azimuth {:.2f} deg", tyre.place[1] * 180 / std::numbers::pi);
  const auto line = table.find("fatigue utilization of tyre in all load cases");
  ASSERT_NE(line, std::string::npos) << table;
  const std::string text = table.substr(line, table.find('\n', line) - line);
  EXPECT_NE(text.find(degrees), std::string::npos) << text;
  EXPECT_NE(text.find(fmt::format("{:.3g} % by driving", 100 * tyre.by_case[1])), std::string::npos) << text;
  const auto json = nlohmann::json::parse(rolling_json(report));
  const auto& of_tyre = json["fatigue_in_all_load_cases"]["by_layer"]["tyre"];
  EXPECT_EQ(of_tyre["life_turns"], *tyre.life);
  EXPECT_EQ(of_tyre["damage_by_load_case"]["driving"], tyre.by_case[1]);
  EXPECT_EQ(json["fatigue"]["by_layer"]["core"]["utilization"], (*report.fatigue)->by_layer[0].utilization);
}

}  // namespace
}  // namespace wheelwright
