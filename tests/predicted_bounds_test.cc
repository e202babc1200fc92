#include "wheelwright/run/study/predicted_bounds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "wheelwright/case/read.h"

namespace wheelwright {
namespace {

std::vector<std::string> warnings_with(const std::string& constraint) {
  const auto read = parse_case(
      "[material]\ndensity = 1200\n[load]\nmass = 300\n[[holes.ring]]\ncount = 16\ncenter_radius = "
      "0.27\nradius = "
      "0.04\n[[constraint]]\n" +
          constraint,
      "wheel.toml");
  EXPECT_TRUE(read.value) << (read.problems.empty() ? "" : read.problems.front().text());
  return predicted_bounds(read.value.value()).warnings;
}

/// The wheel has 6300 N/mm: 5.3e7 N/m per metre of width, and 6.3e6 N/m on its whole width of 0.12 m.
TEST(BoundWarnings, DetectBoundsOfTheWholeWidth) {
  EXPECT_TRUE(warnings_with("quantity = \"stiffness\"\nat_least = 58e6\n").empty());
  EXPECT_TRUE(warnings_with("quantity = \"stiffness\"\nat_least = 25e6\n").empty());
  const auto whole = warnings_with("quantity = \"stiffness\"\nat_least = 6e6\n");
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_NE(whole[0].find("720 N/mm on the whole width"), std::string::npos) << whole[0];
  const auto quoted = whole[0].substr(whole[0].find('"'));
  EXPECT_TRUE(warnings_with("quantity = \"stiffness\"\nat_least = " + quoted + "\n").empty()) << quoted;
}

TEST(BoundWarnings, ConcernOnlyQuantitiesPerWidth) {
  EXPECT_EQ(warnings_with("quantity = \"mass\"\nat_most = 20\n").size(), 1u);
  EXPECT_TRUE(warnings_with("quantity = \"mass\"\nat_most = 180\n").empty());
  // A tenth of the initial run-out is a bound to ask for, and stresses do not depend on the width.
  EXPECT_TRUE(warnings_with("quantity = \"run_out\"\nat_most = 2e-5\n").empty());
  EXPECT_TRUE(warnings_with("quantity = \"peak_von_mises\"\nat_most = 0.15e6\n").empty());
}

}  // namespace
}  // namespace wheelwright
