#include "wheelwright/run/study/filled_holes.h"

#include <nlohmann/json.hpp>

#include "tests/run_support.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/case/read.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::testing {
namespace {

Case case_of(const std::string& text) {
  const auto read = parse_case(text, "case.toml");
  for (const auto& problem : read.problems) ADD_FAILURE() << problem.text();
  return *read.value;
}

template <int dim>
std::optional<Failure> fault(const Case& c, double wall, double gap) {
  EvolutionOptions options = evolution_options(c);
  options.features = {.wall = wall, .gap = gap};
  return filled_holes(initial_shape<dim>(c), options);
}

bool names(const std::optional<Failure>& fault, const std::string& key) {
  return fault && fault->detail.find(key) != std::string::npos;
}

/// The width that the failure advises [m]. It leaves holes, and is at least seven eighths of the largest that
/// does.
double advised(const Failure& fault) {
  const auto at = fault.detail.find("; ");
  return 1e-3 * std::strtod(fault.detail.c_str() + at + 2, nullptr);
}

// Two holes of different width, none of them symmetric in the sector.
TEST(FilledHoles, GapsMayBeAsWideAsTheWidestHole) {
  const Case c = case_of(
      "[wheel]\nsectors = 8\n[grid]\nradial_cells = 28\nangular_cells = 384\n"
      "[[shape.circle]]\ncount = 8\ncenter_radius = 0.265\nradius = 0.03\nphase = 7\n"
      "[[shape.circle]]\ncount = 8\ncenter_radius = 0.28\nradius = 0.015\nphase = 29\n");
  for (const double gap : {0.03, 0.05, 0.057}) EXPECT_FALSE(fault<2>(c, 0, gap)) << gap;
  for (const double gap : {0.066, 0.08, 0.12}) {
    const auto found = fault<2>(c, 0, gap);
    ASSERT_TRUE(names(found, "optimizer.minimum_gap")) << gap;
    EXPECT_FALSE(fault<2>(c, 0, advised(*found))) << gap;
    EXPECT_GT(advised(*found), 0.06 - gap / 8) << gap;
  }
}

// A corner of that radius needs a hole that is twice as wide.
TEST(FilledHoles, RadiiMayBeThoseOfTheWidestHole) {
  const Case c = case_of(
      "[wheel]\nsectors = 8\n[grid]\nradial_cells = 28\nangular_cells = 384\n"
      "[[shape.circle]]\ncount = 8\ncenter_radius = 0.265\nradius = 0.03\nphase = 7\n");
  const auto fault_of = [&](double radius) {
    Case asked = c;
    asked.optimizer.minimum_radius = radius;
    return filled_holes(initial_shape<2>(asked), evolution_options(asked));
  };
  EXPECT_FALSE(fault_of(0.028));
  const auto found = fault_of(0.034);
  ASSERT_TRUE(names(found, "optimizer.minimum_radius"));
  EXPECT_FALSE(fault_of(advised(*found)));
}

// Holes whose centres are 26.5 mm apart leave no room for walls of that width.
TEST(FilledHoles, WallsMayBeAsWideAsTheDistanceOfHoles) {
  const Case c = case_of(
      "[wheel]\nsectors = 64\n[grid]\nradial_cells = 28\nangular_cells = 384\n"
      "[[shape.circle]]\ncount = 64\ncenter_radius = 0.27\nradius = 0.008\nphase = 2\n");
  EXPECT_FALSE(fault<2>(c, 0.018, 0));
  const auto found = fault<2>(c, 0.03, 0);
  ASSERT_TRUE(names(found, "optimizer.minimum_wall"));
  EXPECT_FALSE(fault<2>(c, advised(*found), 0));
}

TEST(FilledHoles, AreFoundInThreeDimensions) {
  const Case c = case_of(
      "[wheel]\ndimension = 3\nsectors = 16\n[optimizer]\ntread_band = 0.024\nrim_band = "
      "0.012\n[grid]\nradial_cells = 12\nangular_cells = 144\naxial_cells = 6\n"
      "[[holes.sphere]]\ncount = 16\ncenter_radius = 0.27\nz = 0.01\nradius = 0.03\n");
  EXPECT_FALSE(fault<3>(c, 0, 0.045));
  EXPECT_TRUE(names(fault<3>(c, 0, 0.07), "optimizer.minimum_gap"));
}

TEST(FilledHoles, AreNoneOfAFullRing) {
  EXPECT_FALSE(fault<2>(case_of("[grid]\nradial_cells = 28\nangular_cells = 192\n"), 0.05, 0.05));
}

class RunWithFilledHoles : public TemporaryFolder {
 protected:
  RunResult<2> run(const Case& c, const char* name) {
    auto run = wheelwright::Run<2>::begin(c, folder() / name);
    CommandQueue commands;
    return run->execute(commands);
  }
};

TEST_F(RunWithFilledHoles, EndsAtItsStartWithTheReasonInItsSummary) {
  run(case_of(small_case(0)), "drawn");
  Case c = case_of(small_case(3));
  c.holes = {};
  c.saved_shape.from = (folder() / "drawn").string();
  ASSERT_TRUE(load_saved_shape(c, {}).empty());
  c.optimizer.minimum_gap = 0.1;
  EXPECT_EQ(run(c, "filled").reason, StopReason::failed_start);
  const auto summary = nlohmann::json::parse(content(folder() / "filled/summary.json"));
  EXPECT_EQ(summary["failure"]["reason"], "too_narrow");
  EXPECT_FALSE(summary.contains("after"));
  c.optimizer.minimum_gap = 0.04;
  EXPECT_NE(run(c, "wide").reason, StopReason::failed_start);
}

}  // namespace
}  // namespace wheelwright::testing
