#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/geometry/topology.h"
#include "wheelwright/report/described_wheel.h"
#include "wheelwright/run/study.h"

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
    {"16 holes, 8 x 96", 16, 8, 96, {0.26}, 16, 0.035},
    {"16 holes, 14 x 192", 16, 14, 192, {0.27}, 16, 0.04},
    {"16 holes, 20 x 200", 8, 20, 200, {0.27}, 16, 0.04},
    {"48 holes, 8 x 96", 24, 8, 96, {0.24, 0.285}, 24, 0.016},
    {"48 holes, 14 x 192", 24, 14, 192, {0.235, 0.294}, 24, 0.0231},
    {"48 holes, 20 x 192", 24, 20, 192, {0.235, 0.294}, 24, 0.0231},
    {"48 holes staggered, 8 x 96", 24, 8, 96, {0.24, 0.285}, 24, 0.016, true},
    {"48 holes staggered, 14 x 192", 24, 14, 192, {0.235, 0.294}, 24, 0.0231, true},
    {"48 holes staggered, 20 x 192", 24, 20, 192, {0.235, 0.294}, 24, 0.0231, true},
    {"108 holes, 14 x 180", 36, 14, 180, {0.2265, 0.2648, 0.3031}, 36, 0.0154},
    {"108 holes, 20 x 216", 36, 20, 216, {0.2263, 0.267, 0.3077}, 36, 0.0154},
};

class CleanEnd : public ::testing::TestWithParam<Start> {};

/// Measured on the curves that are fitted to the last outline, which know nothing of how the shape was made.
TEST_P(CleanEnd, HasWallsAndGapsOfACell) {
  const Course course = course_of(case_text(GetParam(), 30));
  const double cell = course.last.shape.lattice.grid().resolution();
  const auto clearances = outline_clearances(course.last.shape);
  ASSERT_TRUE(clearances.wall && clearances.gap);
  EXPECT_GT(clearances.wall->width, 0.95 * cell);
  EXPECT_GT(clearances.gap->width, 0.95 * cell);
  EXPECT_EQ(course.last.final_widths, FinalWidths::kept);
  EXPECT_NEAR(course.last.measure, course.last.target_measure, 1e-6 * course.last.target_measure);
  if (clearances.gap->width < 0.95 * cell || clearances.wall->width < 0.95 * cell) {
    auto n = course.last.shape;
    for (double& v : n.values) v = -v;
    const auto w = thin_walls(course.last.shape, 0.5 * cell), g = thin_walls(n, 0.5 * cell);
    double lw = 1, lg = 1;
    for (auto& b : w) lw = std::min(lw, b.radius);
    for (auto& b : g) lg = std::min(lg, b.radius);
    fmt::print("walls {} {} gaps {} {}; wall at {} {} gap at {} {}\n", w.size(), 2 * lw / cell, g.size(), 2 * lg / cell,
               std::hypot(clearances.wall->from[0], clearances.wall->from[1]), std::atan2(clearances.wall->from[1], clearances.wall->from[0]),
               std::hypot(clearances.gap->from[0], clearances.gap->from[1]), std::atan2(clearances.gap->from[1], clearances.gap->from[0]));
    for (const auto& hole : components(course.last.shape).all) fmt::print("  {} {} at {} {}\n", hole.is_material, hole.measure, hole.centre[0], hole.centre[1]);
  }
  fmt::print("{}: wall {:.2f}, gap {:.2f} cells; J {:.4f} -> {:.4f}, {} shapes ({})\n", GetParam().name,
             clearances.wall->width / cell, clearances.gap->width / cell,
             course.trials.front().evaluation->function("objective").value,
             course.last.evaluation.function("objective").value, course.last.iteration,
             to_string(course.reason));
}

INSTANTIATE_TEST_SUITE_P(Starts, CleanEnd, ::testing::ValuesIn(starts));

}  // namespace
}  // namespace wheelwright
