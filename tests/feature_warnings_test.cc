#include "wheelwright/run/feature_warnings.h"

#include <gtest/gtest.h>

#include "wheelwright/case/read.h"

namespace wheelwright {
namespace {

/// A ring of round holes of 30 mm.
Case wheel_of_round_holes() {
  const auto read =
      parse_case("[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.03\n", "case.toml");
  return read.value.value();
}

std::size_t n_warnings(const Case& c) {
  const auto measures = initial_outline_measures(c);
  EXPECT_TRUE(measures);
  return feature_warnings(c, *measures).size();
}

TEST(FeatureWarnings, CornersSharperThanAsked) {
  Case c = wheel_of_round_holes();
  EXPECT_EQ(n_warnings(c), 0u);
  c.optimizer.minimum_radius = 0.0295;
  EXPECT_EQ(n_warnings(c), 0u);
  c.optimizer.minimum_radius = 0.033;
  EXPECT_EQ(n_warnings(c), 1u);
}

TEST(FeatureWarnings, WallsAndGapsNarrowerThanAsked) {
  Case c = wheel_of_round_holes();
  const double wall = 0.34 - 0.3;  // to the tread; the wall between two holes has 45 mm
  c.optimizer.minimum_wall = 0.999 * wall;
  c.optimizer.minimum_gap = 0.0599;
  EXPECT_EQ(n_warnings(c), 0u);
  c.optimizer.minimum_wall = 1.02 * wall;
  EXPECT_EQ(n_warnings(c), 1u);
  c.optimizer.minimum_gap = 0.061;
  EXPECT_EQ(n_warnings(c), 2u);
}

}  // namespace
}  // namespace wheelwright
