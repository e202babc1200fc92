#include "wheelwright/run/study/feature_warnings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/case/read.h"

namespace wheelwright {
namespace {

/// A ring of round holes 0.27 m from the axle.
Case wheel_of_round_holes(int count, double radius) {
  const auto read = parse_case(
      fmt::format("[[holes.ring]]\ncount = {}\ncenter_radius = 0.27\nradius = {}\n", count, radius),
      "case.toml");
  return read.value.value();
}

std::size_t n_warnings(const Case& c) {
  const auto measures = initial_outline_measures(c);
  EXPECT_TRUE(measures);
  return feature_warnings(c, *measures).size();
}

TEST(FeatureWarnings, CornersSharperThanAsked) {
  Case c = wheel_of_round_holes(16, 0.03);
  EXPECT_EQ(n_warnings(c), 0u);
  c.optimizer.minimum_radius = 0.0295;
  EXPECT_EQ(n_warnings(c), 0u);
  c.optimizer.minimum_radius = 0.033;
  EXPECT_EQ(n_warnings(c), 1u);
}

TEST(FeatureWarnings, WallsAndGapsNarrowerThanAsked) {
  Case c = wheel_of_round_holes(32, 0.019);
  const double wall = 2 * 0.27 * std::sin(std::numbers::pi / 32) - 2 * 0.019;  // between two holes
  c.optimizer.minimum_wall = 0.999 * wall;
  c.optimizer.minimum_gap = 0.0379;
  EXPECT_EQ(n_warnings(c), 0u);
  c.optimizer.minimum_wall = 1.02 * wall;
  EXPECT_EQ(n_warnings(c), 1u);
  c.optimizer.minimum_gap = 0.039;
  EXPECT_EQ(n_warnings(c), 2u);
}

}  // namespace
}  // namespace wheelwright
