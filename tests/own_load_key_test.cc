#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/takes_any_case.h"
#include "wheelwright/base/units.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/load_values.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/set_number.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/observers/command_log.h"
#include "wheelwright/run/study/study.h"

// Keys of [load] that a program adds: from its case file to the loads on the wheel.

namespace wheelwright {
namespace {

using testing::TakesAnyCase;

constexpr double degree = 3.14159265358979323846 / 180;

/// A road that climbs: it pulls the axle back.
OwnLoadKey slope() {
  return {.name = "slope",
          .unit = "deg",
          .meaning = "angle of the road",
          .range = between(-30, 30),
          .factor = degree,
          .effect = []<int dim>(double angle, const RollingModel<dim>& wheel, WheelLoads<dim>& loads) {
            loads.horizontal_force -= wheel.load * std::tan(angle);
          }};
}

/// Wind from the side, in 3D only; by default 10 N.
OwnLoadKey crosswind() {
  return {.name = "crosswind",
          .unit = "N",
          .meaning = "force of the wind",
          .range = between(-1e3, 1e3),
          .usual = 10,
          .effect = [](double force, const RollingModel<3>&, WheelLoads<3>& loads) {
            loads.lateral_force += force;
          }};
}

OwnLoadKeys own_keys() {
  OwnLoadKeys keys;
  keys.add(slope());
  keys.add(crosswind());
  return keys;
}

std::string text_of(int dimension, const std::string& load) {
  return "[wheel]\nsectors = 8\ndimension = " + std::to_string(dimension) +
         "\n[optimizer]\nrim_band = 0.02\ntread_band = 0.04\n[contact]\nfriction = 0.9\n[grid]\nradial_cells "
         "= 7\nangular_cells = 96\n"
         "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.02\n"
         "[load]\nforce = 1000\npositions = 2\n" +
         load;
}

Case case_with(int dimension, const std::string& load) {
  const CaseResult read = parse_case(text_of(dimension, load), "case.toml", {.load_keys = own_keys()});
  for (const Diagnostic& problem : read.problems) ADD_FAILURE() << problem.text();
  return read.value.value();
}

const std::string two_loads =
    "slope = 5\n[[load.case]]\nname = \"road\"\n[[load.case]]\nname = \"hill\"\nslope = -8\n";

template <int dim>
double along_ground(double angle) {
  return -1000 / whole_width(dim, 0.12) * std::tan(angle * degree);
}

template <int dim>
void expect_loads_on_the_wheel() {
  const Case c = case_with(dim, two_loads);
  const RollingModel<dim> model = rolling_model<dim>(c);
  const LoadCases<dim> cases = load_cases<dim>(c);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_NEAR(model.horizontal_force, along_ground<dim>(5), 1e-9);
  EXPECT_NEAR(cases[0].model.horizontal_force, along_ground<dim>(5), 1e-9);
  EXPECT_NEAR(cases[1].model.horizontal_force, along_ground<dim>(-8), 1e-9);
  EXPECT_EQ(model.lateral_force, dim == 3 ? 10 : 0);
}

TEST(OwnLoadKeys, ActOnTheWheelInEveryLoadCase) {
  expect_loads_on_the_wheel<2>();
  expect_loads_on_the_wheel<3>();
}

TEST(OwnLoadKeys, GiveWhatTheBuiltInKeyGives) {
  const auto energy = [](const std::string& load) {
    const auto study = make_study<2>(case_with(2, load));
    return evaluate_of(*study)({study->initial, nullptr}, nullptr)->evaluation.function("objective").value;
  };
  const double built_in = energy("horizontal_force = " + std::to_string(-1000 * std::tan(5 * degree)) + "\n");
  EXPECT_NEAR(energy("slope = 5\n"), built_in, 1e-6 * built_in);
  EXPECT_GT(std::abs(energy("") - built_in), 1e-4 * built_in);
}

TEST(OwnLoadKeys, AreWrittenAndReadBack) {
  for (const int dimension : {2, 3}) {
    const Case c = case_with(dimension, two_loads);
    EXPECT_NEAR(c.load.own[0].value, 5 * degree, 1e-15);
    EXPECT_EQ(c.load.own[1].value, 10);
    EXPECT_FALSE(c.load.cases[0].own[0].value);
    const CaseResult again = parse_case(to_toml(c), "case.toml", c.vocabulary);
    ASSERT_TRUE(again.value);
    EXPECT_EQ(*again.value, c);
  }
}

TEST(OwnLoadKeys, AreCheckedAndKnownToTheirProgramOnly) {
  const auto problems = [](const std::string& load, const OwnLoadKeys& keys) {
    return parse_case(text_of(2, load), "case.toml", {.load_keys = keys}).problems;
  };
  for (const std::string& load : {std::string("slope = 31\n"), std::string("slope = \"steep\"\n"),
                                  std::string("[[load.case]]\nname = \"hill\"\nslope = -31\n")}) {
    const auto found = problems(load, own_keys());
    ASSERT_EQ(found.size(), 1u) << load;
    EXPECT_TRUE(found.front().key.ends_with(".slope")) << found.front().key;
    EXPECT_GT(found.front().line, 0);
  }
  EXPECT_TRUE(problems(two_loads, own_keys()).empty());
  EXPECT_EQ(problems(two_loads, {}).size(), 2u);
}

TEST(OwnLoadKeys, HaveNamesThatAreFree) {
  OwnLoadKeys keys = own_keys();
  for (const std::string name : {"slope", "torque", "mass", "case", "weight", "name", "two words", ""}) {
    OwnLoadKey key = slope();
    key.name = name;
    EXPECT_THROW(keys.add(key), std::invalid_argument) << name;
  }
  EXPECT_EQ(keys, own_keys());
  EXPECT_NE(keys, OwnLoadKeys());
}

TEST(OwnLoadKeys, AreSetByTheirPath) {
  Case c = case_with(2, two_loads);
  EXPECT_FALSE(set_number(c, "load.slope", 7));
  EXPECT_NEAR(c.load.own[0].value, 7 * degree, 1e-15);
  EXPECT_FALSE(set_number(c, "load.case[1].slope", -7));
  EXPECT_NEAR(c.load.cases[0].own[0].value.value(), -7 * degree, 1e-15);
  EXPECT_TRUE(set_number(c, "load.slope", 31));
}

/// A load with another slope, as a page sends it back.
Command new_slope(Load load, double angle, std::optional<std::string> load_case) {
  load.own[0].value = angle * degree;
  const auto command =
      parse_command(command_json(NewLoad{load, std::move(load_case)}), commands_of_every_run(own_keys()));
  if (!command) throw std::runtime_error(command.failure().reason);
  return *command;
}

TEST(OwnLoadKeys, AreChangedByCommands) {
  TakesAnyCase single(case_with(2, "slope = 5\n"));
  ASSERT_TRUE(new_slope(single.current_case().load, 6, {}).execute(single));
  EXPECT_NEAR(rolling_model<2>(single.current_case()).horizontal_force, along_ground<2>(6), 1e-9);

  TakesAnyCase several(case_with(2, two_loads));
  const Load road = with_load_case(several.current_case(), 0).load;
  ASSERT_TRUE(new_slope(road, 6, "road").execute(several));
  EXPECT_NEAR(load_cases<2>(several.current_case())[0].model.horizontal_force, along_ground<2>(6), 1e-9);
  EXPECT_NEAR(load_cases<2>(several.current_case())[1].model.horizontal_force, along_ground<2>(-8), 1e-9);
}

TEST(OwnLoadKeys, AreInTheLogAndTheTextsOfCommands) {
  const Load load = case_with(2, "slope = 5\n").load;
  const std::string line = log_line({{3, 1}, NewLoad{load, {}}});
  const auto log = parse_command_log(line, commands_of_every_run(own_keys()));
  ASSERT_TRUE(log) << log.failure().reason;
  EXPECT_EQ(log->front().command.get_if<NewLoad>()->load, load);
  EXPECT_FALSE(parse_command_log(line));
  EXPECT_NE(load_text(load), load_text(case_with(2, "").load));
}

/// A program that does not know the keys of a case cannot drop their values.
TEST(OwnLoadKeys, AreInEveryNewLoad) {
  TakesAnyCase run(case_with(2, "slope = 5\n"));
  EXPECT_FALSE(Command(NewLoad{Load{}, {}}).execute(run));
  EXPECT_NEAR(run.current_case().load.own[0].value, 5 * degree, 1e-15);
}

}  // namespace
}  // namespace wheelwright
