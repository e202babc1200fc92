#include "wheelwright/output/report/load_marks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/support.h"

namespace wheelwright::testing {
namespace {

/// The ends of all straight strokes, in pixels.
std::vector<std::array<Vec<2>, 2>> strokes(const std::string& svg) {
  static const std::regex line("d=\"M([0-9.-]+) ([0-9.-]+)L([0-9.-]+) ([0-9.-]+)\"");
  std::vector<std::array<Vec<2>, 2>> found;
  for (std::sregex_iterator p(svg.begin(), svg.end(), line), end; p != end; ++p)
    found.push_back(
        {Vec<2>{std::stod((*p)[1]), std::stod((*p)[2])}, {std::stod((*p)[3]), std::stod((*p)[4])}});
  return found;
}

// The load's arrow ends at the axle and points to the ground, the other one begins there and points along it.
TEST(ForceMarks, AreArrowsAlongTheForcesThroughTheAxle) {
  const auto grid = paper_model(7, 96).grid;
  const PictureView view{.centre = {0.02, -0.01}, .half = 0.4, .left = 30, .top = 50, .size = 600};
  const Vec<2> axle{0.07, 0.04}, at = view.pixel(axle);
  for (const double sign : {-1.0, 1.0}) {
    const auto drawn =
        strokes(force_marks(view, axle, {.towards_ground = 3000 * sign, .along_ground = 1000 * sign}, grid));
    ASSERT_EQ(drawn.size(), 2u);
    const auto& [load, along] = std::pair(drawn[0], drawn[1]);
    EXPECT_NEAR(load[0][0], at[0], 0.06);
    EXPECT_NEAR(load[1][0], at[0], 0.06);
    EXPECT_GT((load[1][1] - load[0][1]) * sign, 10);
    EXPECT_LT((load[1][1] - at[1]) * sign, 0);
    EXPECT_GT((load[1][1] - at[1]) * sign, -10);
    EXPECT_NEAR(along[0][0], at[0], 0.06);
    EXPECT_NEAR(along[0][1], at[1], 0.06);
    EXPECT_NEAR(along[1][1], at[1], 0.06);
    EXPECT_GT((along[1][0] - along[0][0]) * sign, 10);
  }
}

}  // namespace
}  // namespace wheelwright::testing
