#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/evolution/feature_size.h"
#include "wheelwright/shape/evolution/medial_balls.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {
namespace {

struct Start {
  const char* name;
  int sectors, radial, angular;
  std::vector<double> center_radii;
  int count;  ///< of every ring
  double radius;
  bool is_staggered = false;
};

std::string case_text(const Start& start, int iterations, const std::string& more = "") {
  std::string holes;
  double phase = 180.0 / start.count;
  for (const double radius : start.center_radii) {
    holes += fmt::format("[[holes.ring]]\ncount = {}\ncenter_radius = {}\nradius = {}\nphase = {}\n",
                         start.count, radius, start.radius, phase);
    if (start.is_staggered) phase += 180.0 / start.count;
  }
  return fmt::format(
      "[wheel]\nsectors = {}\n[load]\nmass = 300\npositions = 4\n[grid]\nradial_cells = {}\nangular_cells = "
      "{}\ntread_levels = 0\n[optimizer]\nrim_band = {}\ntread_band = {}\niterations = {}\n{}\n{}",
      start.sectors, start.radial, start.angular, std::max(0.01, 0.14 / start.radial),
      std::max(0.01, 0.28 / start.radial), iterations, more, holes);
}

struct Course {
  std::vector<Trial<2>> trials;
  OptimizationState<2> last;
  StopReason reason;
};

Course course_of(const std::string& text) {
  const auto read = parse_case(text, "wheel.toml");
  EXPECT_TRUE(read.value) << (read.problems.empty() ? "" : read.problems.front().text());
  const auto study = make_study<2>(read.value.value());
  const auto optimizer = optimizer_of(*study);
  std::vector<Trial<2>> trials;
  const auto observe = [&](const Trial<2>& trial, const OptimizationState<2>&) { trials.push_back(trial); };
  auto state = optimizer.start(study->initial, observe);
  EXPECT_TRUE(state) << state.failure().detail;
  const StopReason reason = optimizer.run(*state, observe, [] { return false; });
  return {std::move(trials), *std::move(state), reason};
}

const Start starts[] = {
    {"Holes16On8x96", 16, 8, 96, {0.26}, 16, 0.035},
    {"Holes16On14x192", 16, 14, 192, {0.27}, 16, 0.04},
    {"Holes16On20x200", 8, 20, 200, {0.27}, 16, 0.04},
    {"Holes48On8x96", 24, 8, 96, {0.24, 0.285}, 24, 0.016},
    {"Holes48On14x192", 24, 14, 192, {0.235, 0.294}, 24, 0.0231},
    {"Holes48On20x192", 24, 20, 192, {0.235, 0.294}, 24, 0.0231},
    {"Holes48StaggeredOn8x96", 24, 8, 96, {0.24, 0.285}, 24, 0.016, true},
    {"Holes48StaggeredOn14x192", 24, 14, 192, {0.235, 0.294}, 24, 0.0231, true},
    {"Holes48StaggeredOn20x192", 24, 20, 192, {0.235, 0.294}, 24, 0.0231, true},
    {"Holes108On14x180", 36, 14, 180, {0.2265, 0.2648, 0.3031}, 36, 0.0154},
    {"Holes108On20x216", 36, 20, 216, {0.2263, 0.267, 0.3077}, 36, 0.0154},
};

class CleanEnd : public ::testing::TestWithParam<Start> {};

/// Measured on the curves that are fitted to the last outline, which know nothing of how the shape was made.
TEST_P(CleanEnd, HasWallsAndGapsOfACell) {
  const Course course = course_of(case_text(GetParam(), 30));
  const double cell = course.last.shape.lattice.grid().resolution();
  const auto measured = outline_measures(course.last.shape);
  ASSERT_TRUE(measured && measured->clearances.wall && measured->clearances.gap);
  const cad::Clearances& clearances = measured->clearances;
  EXPECT_GT(clearances.wall->width, 0.95 * cell);
  EXPECT_GT(clearances.gap->width, 1.42 * cell);
  const double radius = course.last.final_widths == FinalWidths::kept ? cell : 0.75 * cell;
  EXPECT_TRUE(narrowest_places(course.last.shape, {.radius = 0.99 * radius}).empty());
  EXPECT_NE(course.last.final_widths, FinalWidths::impossible);
  EXPECT_NEAR(course.last.measure, course.last.target_measure, 1e-6 * course.last.target_measure);
  const auto value = [](const Evaluation<2>& evaluation) { return evaluation.function("objective").value; };
  EXPECT_LT(value(course.last.evaluation), value(*course.trials.front().evaluation));
  RecordProperty("widths", fmt::format("wall {:.2f}, gap {:.2f} cells", clearances.wall->width / cell,
                                       clearances.gap->width / cell));
}

INSTANTIATE_TEST_SUITE_P(Starts, CleanEnd, ::testing::ValuesIn(starts),
                         [](const auto& start) { return start.param.name; });

const Start& start_named(std::string_view name) { return *std::ranges::find(starts, name, &Start::name); }

bool has_event(const Trial<2>& trial, ShapeEventKind kind) {
  return std::ranges::any_of(trial.events, [&](const auto& event) { return event.kind == kind; });
}

/// 48 holes, whose webs become thinner than a cell.
TEST(FinalWidths, AreRepairedOnceInASeparateShape) {
  const Course course = course_of(case_text(start_named("Holes48On20x192"), 15));
  std::vector<const Trial<2>*> repaired;
  for (const auto& trial : course.trials)
    if (has_event(trial, ShapeEventKind::thin_wall_repaired)) repaired.push_back(&trial);
  ASSERT_EQ(repaired.size(), 1u);
  const Trial<2>& first = *repaired.front();
  EXPECT_EQ(first.verdict, Verdict::accepted);
  EXPECT_EQ(first.step, 0);
  EXPECT_GE(first.iteration, 1);
  EXPECT_LT(first.iteration, 15);
  // Objectives before are not compared with: the history begins with it.
  EXPECT_EQ(course.last.history_begin, first.iteration);
  EXPECT_EQ(course.last.history.front().objective, first.evaluation->function("objective").value);
  for (const auto& trial : course.trials) {
    if (trial.verdict != Verdict::accepted || trial.iteration < first.iteration) continue;
    EXPECT_TRUE(thin_walls(trial.shape, 0.48 * trial.shape.lattice.grid().resolution()).empty());
  }
  // The other way to mend was tried before, and is worse.
  const auto other = std::ranges::find_if(course.trials, [&](const Trial<2>& trial) {
    return trial.iteration == first.iteration && trial.step == 0 && trial.verdict != Verdict::accepted;
  });
  ASSERT_NE(other, course.trials.end());
  EXPECT_LT(other->halvings, first.halvings);
  if (other->evaluation) {
    EXPECT_GT(other->evaluation->function("objective").value, first.evaluation->function("objective").value);
  }
}

/// Holes of about four cells have room for corners with a radius of a cell; what remains of staggered holes
/// does not.
TEST(FinalWidths, CornersAreSharperWhereThereIsNoRoom) {
  EXPECT_EQ(course_of(case_text(start_named("Holes16On14x192"), 12)).last.final_widths, FinalWidths::kept);
  EXPECT_EQ(course_of(case_text(start_named("Holes48StaggeredOn14x192"), 30)).last.final_widths,
            FinalWidths::kept_with_sharper_corners);
}

TEST(FinalWidths, ShapesThatHaveThemAreUnchanged) {
  const Course course = course_of(case_text(start_named("Holes16On14x192"), 9, "minimum_radius = 0\n"));
  EXPECT_EQ(course.last.final_widths, FinalWidths::kept);
  EXPECT_EQ(course.last.history_begin, 0);
  for (const auto& trial : course.trials) EXPECT_TRUE(trial.iteration == 0 || trial.step > 0);
}

// The run ends after 8 shapes, whose last one has the widths: what is saved there must lead to the same
// trials and to the same end.
TEST(FinalWidths, ARunContinuedFromItsEndEndsThereByTheSameTrials) {
  const auto read = parse_case(R"(
[wheel]
sectors = 11
[load]
force = 2943
positions = 2
[[holes.ring]]
count = 11
center_radius = 0.25596117063719137
radius = 0.0361583697628822
phase = 16.363636363636363
[grid]
radial_cells = 8
angular_cells = 88
dilatation = "pointwise"
tread_levels = 0
[volume]
target = 0.8095737468130748
[optimizer]
iterations = 100
accepted_increase = 0
tolerance = 0
redistance_every = 3
smoothing = 0.1
smooth_every = 4
rim_band = 0.0175
tread_band = 0.035
)",
                               "wheel.toml");
  const auto study = make_study<2>(read.value.value());
  const auto optimizer = optimizer_of(*study);
  std::vector<double> objectives;
  const auto observe = [&](const Trial<2>& trial, const OptimizationState<2>&) {
    if (trial.verdict == Verdict::accepted)
      objectives.clear();
    else if (trial.evaluation)
      objectives.push_back(trial.evaluation->function("objective").value);
  };
  auto state = *optimizer.start(study->initial, observe);
  const auto run_on = [&] { return optimizer.run(state, observe, [] { return false; }); };
  ASSERT_EQ(run_on(), StopReason::no_descent);
  const auto at_the_end = std::exchange(objectives, {});
  const int shapes = state.iteration;
  ASSERT_GT(at_the_end.size(), 1u);
  EXPECT_EQ(run_on(), StopReason::no_descent);
  EXPECT_EQ(state.iteration, shapes);
  EXPECT_EQ(objectives, at_the_end);
}

/// Holes of two cells become slits that cannot be repaired: such shapes keep the widths, if they have them.
TEST(FinalWidths, AreEnforcedFromTheStartForSmallHoles) {
  int n_small = 0;
  for (const Start& start : starts) {
    const Course course = course_of(case_text(start, 2));
    const LevelSet<2>& first = course.trials.front().shape;
    const double cell = first.lattice.grid().resolution();
    const bool has_widths =
                   narrowest_places(first, {.wall = 1.05 * cell, .gap = 1.5 * cell, .radius = 0.5 * cell})
                       .empty(),
               has_small_holes = 2 * start.radius < 1.8 * 1.5 * cell;
    const bool is_expected = has_widths && has_small_holes;
    EXPECT_EQ(course.last.final_widths == FinalWidths::kept_with_sharper_corners, is_expected) << start.name;
    if (!is_expected) continue;
    ++n_small;
    for (const auto& trial : course.trials)
      if (trial.verdict == Verdict::accepted) {
        const double radius = trial.iteration == 0 ? 0.5 * cell : 0.74 * cell;
        EXPECT_TRUE(
            narrowest_places(trial.shape, {.wall = cell, .gap = 1.45 * cell, .radius = radius}).empty())
            << start.name;
      }
  }
  EXPECT_GE(n_small, 1);
}

TEST(FinalWidths, AreNotUsedIfTheCaseGivesWidths) {
  const Start& start = start_named("Holes48On20x192");
  const Course any = course_of(case_text(start, 15, "minimum_wall = 0\nminimum_gap = 0\n"));
  EXPECT_EQ(any.last.final_widths, FinalWidths::not_yet);
  const double cell = any.last.shape.lattice.grid().resolution();
  EXPECT_FALSE(thin_walls(any.last.shape, 0.4 * cell).empty());
}

/// The steps of this wheel, which follow a bound that curves, fall to a thirtieth of a cell long before the
/// optimum: the search then begins again with full steps.
TEST(Convergence, ARestartGainsLittle) {
  const auto read = parse_case(R"(
[wheel]
inner_radius = 0.2
outer_radius = 0.34
sectors = 24
[material]
density = 1100
youngs_modulus = 200e6
poissons_ratio = 0.479
[load]
mass = 195
[grid]
radial_cells = 20
angular_cells = 264
[[shape.slot]]
count = 24
center_radius = 0.27
length = 0.0815
width = 0.0251
[objective]
minimize = "mass"
[[constraint]]
quantity = "stiffness"
at_least = 67.47e6
[optimizer]
rim_band = 0.01
tread_band = 0.014
)",
                               "slots.toml");
  const auto study = make_study<2>(read.value.value());
  const auto optimizer = optimizer_of(*study);
  const auto ignore = [](const Trial<2>&, const OptimizationState<2>&) {};
  auto state = *optimizer.start(study->initial, ignore);
  const auto mass_at_the_end = [&] {
    EXPECT_EQ(optimizer.run(state, ignore, [] { return false; }), StopReason::converged);
    return state.history.back().objective;
  };
  const double mass = mass_at_the_end();
  state = *optimizer.restart(state, ignore);
  EXPECT_LT(mass / mass_at_the_end() - 1, 0.002);
}

}  // namespace
}  // namespace wheelwright
