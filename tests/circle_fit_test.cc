#include "wheelwright/cad/outline/circle_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace wheelwright::cad {
namespace {

// In the sense of the points, wherever the circle lies and whichever point is the first.
TEST(CircleFit, StartsAtTheFirstPointAndTurnsOnce) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Vec<2> centre{uniform(random), uniform(random)};
    const double radius = std::pow(10.0, -2 + uniform(random)), begin = 4 * uniform(random);
    const double sense = k % 2 == 0 ? 1 : -1;
    std::vector<Vec<2>> points;
    for (int i = 0; i < 40; ++i) {
      const double angle = begin + sense * 2 * std::numbers::pi * i / 40;
      points.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
    }
    const auto circle = fit_circle(points, 1e-9);
    ASSERT_TRUE(circle) << k;
    EXPECT_NEAR(circle->radius, radius, 1e-10);
    for (int d = 0; d < 2; ++d) EXPECT_NEAR(circle->centre[d], centre[d], 1e-10);
    EXPECT_NEAR(circle->centre[0] + radius * std::cos(circle->begin), points[0][0], 1e-10) << k;
    EXPECT_NEAR(circle->centre[1] + radius * std::sin(circle->begin), points[0][1], 1e-10) << k;
    EXPECT_NEAR(circle->sweep, sense * 2 * std::numbers::pi, 1e-12);
  }
}

}  // namespace
}  // namespace wheelwright::cad
