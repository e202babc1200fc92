#include "wheelwright/shape/geometry/nearest_point.h"

#include <gtest/gtest.h>

#include <random>

namespace wheelwright {
namespace {

/// Points on a lattice, some of them twice: many are equally near to points midway between them.
std::vector<Vec<2>> lattice_points() {
  std::vector<Vec<2>> points;
  for (int k = 0; k < 450; ++k) points.push_back({0.1 * (k % 20), 0.1 * (k / 20 % 20)});
  return points;
}

/// The first of the nearest points.
int nearest_of(const std::vector<Vec<2>>& points, const Vec<2>& x) {
  int best = 0;
  for (int k = 1; k < static_cast<int>(points.size()); ++k)
    if (norm(x - points[k]) < norm(x - points[best]) * (1 - 1e-12)) best = k;
  return best;
}

TEST(NearestPoint, GuessesAndBoundsDoNotChangeWhatIsFound) {
  const auto points = lattice_points();
  const NearestPoint<2> nearest(points);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> half_steps(0, 40), any(0, 449);
  for (int k = 0; k < 2000; ++k) {
    const Vec<2> x{0.05 * half_steps(random) + 1e-3, 0.05 * half_steps(random)};
    const int found = nearest.index_of_nearest(x);
    const double distance = norm(x - points[found]);
    EXPECT_NEAR(distance, norm(x - points[nearest_of(points, x)]), 1e-12);
    EXPECT_EQ(nearest.index_of_nearest(x, any(random)), found);
    EXPECT_EQ(nearest.index_of_nearest(x, found), found);
    EXPECT_EQ(nearest.index_of_nearest_within(distance, x), found);
    EXPECT_EQ(nearest.index_of_nearest_within(0.99 * distance, x), -1);
  }
  EXPECT_EQ(nearest.index_of_nearest(points[7], 449), 7);
  EXPECT_EQ(nearest.index_of_nearest_within(0, points[7]), 7);
}

}  // namespace
}  // namespace wheelwright
