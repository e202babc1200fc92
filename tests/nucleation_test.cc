#include "wheelwright/optimization/nucleation/nucleation.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "tests/run_support.h"
#include "tests/support.h"
#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/read.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/run/session/run.h"

namespace wheelwright::testing {
namespace {

/// The middles of all cells, with a cost that is smallest at one place of the sector.
struct Costs {
  std::vector<MaterialPoint<2>> points;
  std::vector<double> values;
  operator HoleCosts<2>() const { return {points, values}; }
};

Costs costs_around(const PolarGrid<2>& grid, double radius, double azimuth, bool with_image) {
  Costs costs;
  const Vec<2> h = grid.cell_size(0);
  const auto distance = [&](const Vec<2>& polar, double at) {
    const double along = polar[0] * std::remainder(polar[1] - at, grid.sector_angle());
    return std::hypot(polar[0] - radius, along);
  };
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const auto place = grid.cell_position(cell);
    const Vec<2> middle{grid.inner_radius + (place[0] + 0.5) * h[0], (place[1] + 0.5) * h[1]};
    double d = distance(middle, azimuth);
    if (with_image) d = std::min(d, distance(middle, grid.sector_angle() - azimuth));
    costs.points.push_back({cell, {0.5, 0.5}});
    costs.values.push_back(100 * d * d - 0.1);
  }
  return costs;
}

LevelSet<2> solid(const PolarGrid<2>& grid) { return make_level_set(Lattice<2>(grid, 2), {}); }

HoleRules rules(const PolarGrid<2>& grid) {
  return {.radius = 0.008, .wall = 0.01, .range = {0.21, 0.33}, .max_measure = 1, .must_pay = true};
}

double apart(const PolarGrid<2>& grid, const Circle& a, const Circle& b) {
  double minimum = INFINITY;
  for (const int image : {-1, 0, 1}) {
    const Vec<2> x = cartesian<2>({a.centre_radius, a.centre_azimuth}),
                 y = cartesian<2>({b.centre_radius, b.centre_azimuth + image * grid.sector_angle()});
    minimum = std::min(minimum, std::hypot(x[0] - y[0], x[1] - y[1]));
  }
  return minimum;
}

TEST(HolePlaces, StartAtTheMinimumCostAndKeepTheirDistance) {
  const auto grid = paper_model(28, 384).grid;
  const auto costs = costs_around(grid, 0.28, 0.11, false);
  const auto holes = best_places<2>(solid(grid), costs, rules(grid));
  ASSERT_GT(holes.size(), 1u);
  EXPECT_NEAR(holes[0].centre_radius, 0.28, 0.003);
  EXPECT_NEAR(holes[0].centre_azimuth, 0.11, 0.01);
  for (size_t i = 0; i < holes.size(); ++i) {
    EXPECT_GE(holes[i].centre_radius, 0.21 + 0.008);
    EXPECT_LE(holes[i].centre_radius, 0.33 - 0.008);
    // The cost is positive farther than sqrt(1e-3) from the place.
    EXPECT_LT(apart(grid, holes[i], {0.28, 0.11, 0}), std::sqrt(1e-3) + 0.004);
    for (size_t j = 0; j < i; ++j) EXPECT_GE(apart(grid, holes[i], holes[j]), 2 * 0.008 + 0.01 - 1e-12);
  }
}

TEST(HolePlaces, AreMirrorImagesWhereTheCostsAre) {
  const auto grid = paper_model(28, 384).grid;
  const double a = grid.sector_angle();
  const auto holes = best_places<2>(solid(grid), costs_around(grid, 0.28, 0.1, true), rules(grid));
  ASSERT_GE(holes.size(), 2u);
  for (const Circle& hole : holes)
    EXPECT_TRUE(std::ranges::any_of(holes, [&](const Circle& other) {
      return std::abs(std::remainder(hole.centre_azimuth + other.centre_azimuth, a)) < 1e-12 &&
             hole.centre_radius == other.centre_radius;
    }));
}

TEST(HolePlaces, AreEmptyIfNoHolePays) {
  const auto grid = paper_model(28, 384).grid;
  auto costs = costs_around(grid, 0.28, 0.11, false);
  const auto with_hole = holes(grid, 2, {{0.28, 0.11, 0.02}});
  for (const Circle& hole : best_places<2>(with_hole, costs, rules(grid)))
    EXPECT_GT(apart(grid, hole, {0.28, 0.11, 0}), 0.02 + 0.008 + 0.01 - 5e-4);
  for (double& value : costs.values) value += 0.13;
  EXPECT_TRUE(best_places<2>(solid(grid), costs, rules(grid)).empty());
  auto in_any_case = rules(grid);
  in_any_case.must_pay = false;
  in_any_case.max_measure = 0;
  EXPECT_EQ(best_places<2>(solid(grid), costs, in_any_case).size(), 1u);
}

TEST(HolePlaces, ShapesHaveTheHolesWithTheirAreas) {
  const auto grid = paper_model(28, 384).grid;
  const Circle hole{0.28, 0.11, 0.008};
  const auto made = with_holes<2>(holes(grid, 2, {{0.25, 0.3, 0.02}}), std::span(&hole, 1));
  const auto all = components(made).all;
  EXPECT_EQ(std::ranges::count_if(all, [](const auto& c) { return !c.is_material; }), 2);
  const auto found =
      std::ranges::find_if(all, [](const auto& c) { return !c.is_material && c.measure < 5e-4; });
  ASSERT_NE(found, all.end());
  EXPECT_NEAR(found->measure, std::numbers::pi * 0.008 * 0.008, 0.1 * found->measure);
}

/// A cost that is smallest at one place of the sector and at its images in both mirror planes.
TEST(HolePlaces, InSpaceAreMirrorImagesInBothPlanes) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 16, {14, 24, 12}};
  const double a = grid.sector_angle();
  const auto folded = [](double x, double extent) { return std::min(x, extent - x); };
  std::vector<MaterialPoint<3>> points;
  std::vector<double> values;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const auto place = grid.cell_position(cell);
    const Vec<3> h = grid.cell_size(0);
    const double radius = grid.inner_radius + (place[0] + 0.5) * h[0],
                 along = radius * (folded((place[1] + 0.5) * h[1], a) - 0.3 * a),
                 height = folded((place[2] + 0.5) * h[2], grid.width) - 0.04;
    points.push_back({cell, {0.5, 0.5, 0.5}});
    values.push_back(100 * (std::pow(radius - 0.27, 2) + along * along + height * height) - 0.04);
  }
  const auto ring = make_level_set<3>(Lattice<3>(grid, 2), {});
  const HoleRules rules{
      .radius = 0.012, .wall = 0.006, .range = {0.21, 0.33}, .max_measure = 1, .must_pay = true};
  const auto holes = best_places<3>(ring, {points, values}, rules);
  ASSERT_GE(holes.size(), 4u);
  EXPECT_NEAR(holes[0].centre_radius, 0.27, 0.006);
  EXPECT_NEAR(folded(holes[0].centre_azimuth, a), 0.3 * a, 0.02);
  EXPECT_NEAR(folded(holes[0].centre_height, grid.width), 0.04, 0.006);
  for (const Sphere& hole : holes) {
    EXPECT_GE(folded(hole.centre_height, grid.width), 0.012 + 0.006);
    for (const Sphere& image :
         {Sphere{hole.centre_radius, a - hole.centre_azimuth, hole.centre_height, 0},
          Sphere{hole.centre_radius, hole.centre_azimuth, grid.width - hole.centre_height, 0}})
      EXPECT_TRUE(std::ranges::any_of(holes, [&](const Sphere& other) {
        return std::abs(std::remainder(other.centre_azimuth - image.centre_azimuth, a)) < 1e-12 &&
               std::abs(other.centre_height - image.centre_height) < 1e-12 &&
               other.centre_radius == image.centre_radius;
      }));
    for (const Sphere& other : holes)
      if (&other != &hole) EXPECT_LE(signed_distance(grid, other, centre(hole)), -0.012 - 0.006 + 1e-12);
  }
  const auto made = components(with_holes<3>(ring, holes)).all;
  EXPECT_EQ(std::ranges::count_if(made, [](const auto& c) { return !c.is_material; }), std::ssize(holes));
}

/// The objective and the multipliers times the gaps of all bounds.
double lagrangian(const Evaluation<2>& evaluation, const std::vector<double>& multipliers) {
  double sum = evaluation.function("objective").value;
  const auto constraints = bound_constraints(evaluation);
  for (size_t i = 0; i < constraints.size(); ++i) sum += multipliers[i] * constraints[i].gap;
  return sum;
}

TEST(Nucleation, WeightsAreTheDerivativesOfTheLagrangian) {
  const auto function = [](const std::string& name, double value, Bounds bounds) {
    return FunctionValue{.name = name, .value = value, .by_position = {}, .gradient = {}, .bounds = bounds};
  };
  OptimizationState<2> state{.shape = solid(paper_model(4, 48).grid),
                             .evaluation = {},
                             .measure = 0,
                             .target_measure = 0,
                             .iteration = 3,
                             .step = 1,
                             .since_redistance = 0,
                             .since_smoothing = 0,
                             .memory = {},
                             .history = {}};
  state.evaluation.functions = {function("stiffness", 6.5, {.lower = 7}), function("objective", 40, {}),
                                function("mass", 21, {.lower = 18, .upper = 20}),
                                function("run_out", 3, {.lower = 2, .upper = 2})};
  state.memory.multipliers = {0.4, 0.3, 1.7, -0.8};
  const OptimizerOptions options;
  ASSERT_EQ(bound_constraints(state.evaluation).size(), 4u);
  const auto weights = lagrangian_weights(options, state);
  for (size_t f = 0; f < weights.size(); ++f) {
    auto more = state.evaluation;
    more.functions[f].value += 0.5;
    const double change =
        lagrangian(more, state.memory.multipliers) - lagrangian(state.evaluation, state.memory.multipliers);
    EXPECT_NEAR(weights[f], change / 0.5, 1e-12) << f;
  }
  state.memory.multipliers.clear();  // not known yet: 1 % of a bound costs 1 % of the objective
  const auto unknown = lagrangian_weights(options, state);
  EXPECT_NEAR(unknown[0] * 0.01 * 7, -0.01 * 40, 1e-12);
  EXPECT_NEAR(unknown[3] * 0.01 * 2, 0.01 * 40, 1e-12);
}

/// A ring without holes, or with some, whose volume is to become 0.66, on a small grid with walls of a cell.
std::string wheel(const std::string& holes, const std::string& nucleation, int iterations = 80) {
  return fmt::format(R"(
[wheel]
sectors = 16
[load]
mass = 300
positions = 4
[volume]
target = 0.6614
rate = 0.02
{}
[grid]
radial_cells = 14
angular_cells = 128
tread_levels = 0
[optimizer]
nucleation = "{}"
rim_band = 0.012
tread_band = 0.02
minimum_wall = 0.012
minimum_gap = 0.015
tolerance = 1e-4
iterations = {}
[output]
folder = "run"
vtu_every = 0
checkpoint_every = 1
)",
                     holes, nucleation, iterations);
}

const std::string sixteen_holes = "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.04\n";

class NucleationRun : public TemporaryFolder {
 protected:
  RunResult<2> run(const std::string& text, const std::string& name = "run") {
    auto run = wheelwright::Run<2>::begin(*parse_case(text, "case.toml").value, folder() / name);
    CommandQueue commands;
    return run->execute(commands);
  }

  std::string history(const std::string& name = "run") { return content(folder() / name / "history.csv"); }
};

double objective(const RunResult<2>& result) { return result.state->evaluation.function("objective").value; }

TEST_F(NucleationRun, SlowGivesASolidRingItsHolesAndEndsNearTheOptimumOfSixteen) {
  const auto with_holes = run(wheel(sixteen_holes, "never"), "holes");
  const auto from_solid = run(wheel("", "converged"), "solid");
  EXPECT_TRUE(history("solid").find("nucleation of") != std::string::npos);
  EXPECT_NEAR(from_solid.state->measure, with_holes.state->measure, 1e-4 * with_holes.state->measure);
  EXPECT_LT(objective(from_solid), 1.02 * objective(with_holes));
}

/// In space, small cavities appear and join to one hole about the axle that the search with drawn grooves
/// also finds: both ends are nearly equal.
TEST_F(NucleationRun, SlowGivesASolidRingInSpaceItsCavities) {
  const auto solid_wheel = [](const std::string& holes, const std::string& nucleation) {
    return fmt::format(R"(
[wheel]
dimension = 3
sectors = 16
[load]
mass = 300
positions = 2
[contact]
quadrature_points = 3
[material]
poissons_ratio = 0.4
{}
[volume]
target = 0.6614
rate = 0.03
[grid]
radial_cells = 10
angular_cells = 128
axial_cells = 6
degree = 1
tread_levels = 0
[optimizer]
nucleation = "{}"
rim_band = 0.014
tread_band = 0.028
iterations = 60
[output]
folder = "run"
vtu_every = 0
)",
                       holes, nucleation);
  };
  const auto in_space = [&](const std::string& text, const std::string& name) {
    const auto parsed = parse_case(text, "case.toml");
    for (const auto& problem : parsed.problems) ADD_FAILURE() << problem.text();
    auto run = wheelwright::Run<3>::begin(*parsed.value, folder() / name);
    CommandQueue commands;
    return run->execute(commands);
  };
  const auto grooves = in_space(
      solid_wheel("[[holes.groove]]\ninner_radius = 0.222\nouter_radius = 0.31\ndepth = 0.033\n", "never"),
      "grooves");
  const auto solid = in_space(solid_wheel("", "converged"), "solid");
  EXPECT_TRUE(history("solid").find("nucleation of") != std::string::npos);
  EXPECT_NEAR(solid.state->measure, grooves.state->measure, 1e-3 * grooves.state->measure);
  EXPECT_LT(solid.state->evaluation.function("objective").value,
            1.02 * grooves.state->evaluation.function("objective").value);
}

/// Rows of accepted shapes in a history.
std::vector<std::vector<std::string>> accepted_rows(const std::string& history) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : split(history, '\n'))
    if (auto cells = split(line, ','); cells.size() > 4 && cells[2] == "1") rows.push_back(std::move(cells));
  return rows;
}

bool tells(const std::vector<std::string>& row, const std::string& event) {
  return std::ranges::any_of(row, [&](const auto& cell) { return cell.find(event) != std::string::npos; });
}

/// The run ends with the very shape that it had before the holes that did not pay.
TEST_F(NucleationRun, SlowThatDoesNotPayIsUndone) {
  const auto finer = [](std::string text) {
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("angular_cells = 128", "angular_cells = 192");
    replace("positions = 4", "positions = 8");
    replace("tread_levels = 0", "tread_levels = 1");
    replace("rim_band = 0.012", "rim_band = 0.01");
    replace("minimum_wall = 0.012", "minimum_wall = 0.01");
    replace("tolerance = 1e-4", "tolerance = 1e-5");
    return text;
  };
  const auto without = run(finer(wheel(sixteen_holes, "never")), "without");
  const auto with = run(finer(wheel(sixteen_holes, "converged")), "with");
  const auto rows = accepted_rows(history("with"));
  const auto undone =
      std::ranges::find_if(rows, [](const auto& row) { return tells(row, "nucleation undone"); });
  ASSERT_NE(undone, rows.end());
  auto made = undone;
  while (made != rows.begin() && !tells(*made, "nucleation of")) --made;
  ASSERT_GT(made - rows.begin(), 0);
  EXPECT_EQ((*undone)[4], (*(made - 1))[4]);  // the objectives
  EXPECT_GT(undone - made, 3);
  EXPECT_EQ(undone + 1, rows.end());
  EXPECT_LE(objective(with), objective(without));
}

/// Stops a run after some accepted shape.
template <int dim>
class StopAt : public Observer<dim> {
 public:
  StopAt(CommandQueue& commands, int trials) : commands_(commands), left_(trials) {}
  void operator()(const Event<dim>& event, const RunView<dim>&) override {
    const auto* done = std::get_if<TrialDone<dim>>(&event);
    if (done && done->trial.verdict == Verdict::accepted && left_-- == 0) commands_.push(Stop{});
  }

 private:
  CommandQueue& commands_;
  int left_;
};

/// The numbers of accepted shapes before, at and after those at which holes appear or are undone, and the
/// first two, as far as one follows.
std::set<int> shapes_to_stop_at(const std::string& history) {
  std::set<int> stops{0, 1};
  int accepted = 0;
  for (const auto& row : accepted_rows(history)) {
    if (tells(row, "nucleation")) stops.insert({accepted - 1, accepted, accepted + 1});
    ++accepted;
  }
  std::erase_if(stops, [&](int stop) { return stop < 0 || stop + 1 >= accepted; });
  return stops;
}

template <int dim>
void expect_to_continue_identically(const std::string& text, const fs::path& folder) {
  const Case c = *parse_case(text, "case.toml").value;
  const auto to_the_end = [](auto run) {
    ASSERT_TRUE(run);
    CommandQueue commands;
    run->execute(commands);
  };
  to_the_end(wheelwright::Run<dim>::begin(c, folder / "straight"));
  const auto history = [&](const char* name) { return content(folder / name / "history.csv"); };
  const std::string straight = history("straight");
  EXPECT_TRUE(straight.find("nucleation of") != std::string::npos);
  for (const int stop : shapes_to_stop_at(straight)) {
    SCOPED_TRACE(fmt::format("stopped after {} accepted shapes", stop + 1));
    fs::remove_all(folder / "stopped");
    {
      auto first = wheelwright::Run<dim>::begin(c, folder / "stopped");
      CommandQueue commands;
      first->add(std::make_unique<StopAt<dim>>(commands, stop));
      EXPECT_EQ(first->execute(commands).reason, StopReason::stop_requested);
    }
    to_the_end(wheelwright::Run<dim>::resume(c, folder / "stopped"));
    EXPECT_EQ(without_times(history("stopped")), without_times(straight));
    EXPECT_EQ(content(folder / "stopped/shape.levelset"), content(folder / "straight/shape.levelset"));
  }
}

TEST_F(NucleationRun, SlowContinuesIdenticallyAfterEveryStop) {
  expect_to_continue_identically<2>(wheel("", "converged", 45), folder());
}

TEST_F(NucleationRun, SlowIn3DContinuesIdenticallyAfterEveryStop) {
  expect_to_continue_identically<3>(R"(
[wheel]
dimension = 3
sectors = 16
[load]
mass = 300
positions = 1
[contact]
quadrature_points = 3
[material]
poissons_ratio = 0.4
[volume]
target = 0.6614
rate = 0.06
[grid]
radial_cells = 10
angular_cells = 128
axial_cells = 4
degree = 1
tread_levels = 0
[optimizer]
nucleation = "converged"
rim_band = 0.014
tread_band = 0.028
tolerance = 1e-3
iterations = 12
[output]
folder = "run"
vtu_every = 0
checkpoint_every = 1
)",
                                    folder());
}

TEST(NucleationCase, IsRefusedWhereTheEffectOfHolesIsNotKnown) {
  const auto found = [](const std::string& text) {
    for (const auto& problem : parse_case(text, "case.toml").problems)
      if (problem.text().find("optimizer.nucleation") != std::string::npos) return true;
    return false;
  };
  const std::string on = "[optimizer]\nnucleation = \"converged\"\n", two = wheel(sixteen_holes, "converged");
  EXPECT_FALSE(found(two));
  const std::string space = "[wheel]\ndimension = 3\n[load]\nmass = 300\n" + sixteen_holes + on;
  EXPECT_FALSE(found(space));
  for (const char* made : {"extruded", "turned", "moulded", "printed"})
    EXPECT_TRUE(found(space + fmt::format("made = \"{}\"\n", made))) << made;
  EXPECT_TRUE(found("[load]\nmass = 300\nhole_pressure = 1e4\n" + sixteen_holes + on));
}

}  // namespace
}  // namespace wheelwright::testing
