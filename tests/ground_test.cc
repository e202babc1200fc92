#include "wheelwright/mechanics/state/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace wheelwright {
namespace {

std::vector<std::pair<std::string, Ground>> uneven_grounds() {
  return {{"bar", Ground::bar(0.03, 0.02, 0.03)},
          {"half sunk bar", Ground::bar(-0.05, 0.02, 0.02)},
          {"kerb", Ground::kerb(0.1, 0.05, 0.02)},
          {"sharp kerb", Ground::kerb(-0.06, 0.05, 0)},
          {"profile", Ground::profile({{-0.2, 0.01}, {-0.1, 0.03}, {0.02, 0}, {0.05, 0.02}, {0.3, 0.01}})}};
}

std::vector<std::pair<std::string, Ground>> all_grounds() {
  auto all = uneven_grounds();
  all.emplace_back("flat", Ground());
  all.emplace_back("drum", Ground::drum(0.4));
  all.emplace_back("internal drum", Ground::internal_drum(0.5));
  return all;
}

// The gap is a distance: its gradient is the unit normal, away from the ground.
TEST(Ground, TheNormalIsTheGradientOfTheGap) {
  std::mt19937 random(1);
  for (const auto& [name, ground] : all_grounds())
    for (int k = 0; k < 200; ++k) {
      const double along = std::uniform_real_distribution<double>(-0.25, 0.25)(random),
                   height = 0.07 + std::uniform_real_distribution<double>(0, 0.1)(random), step = 1e-6;
      const auto gap = [&on = ground](double x, double y) { return on.nearest({x, y}).gap; };
      const auto [at, tilt] = ground.nearest({along, height});
      const double before = ground.nearest({along - 2 * step, height}).tilt,
                   after = ground.nearest({along + 2 * step, height}).tilt;
      if (std::abs(after - before) > 1e-3) continue;  // above the middle of a valley
      EXPECT_NEAR((gap(along + step, height) - gap(along - step, height)) / (2 * step), -std::sin(tilt), 1e-5)
          << name << " at " << along << ", " << height;
      EXPECT_NEAR((gap(along, height + step) - gap(along, height - step)) / (2 * step), std::cos(tilt), 1e-5)
          << name << " at " << along << ", " << height;
    }
}

// Against the nearest of many points of the outline.
TEST(Ground, TheGapIsTheDistanceToTheOutline) {
  std::mt19937 random(2);
  for (const auto& [name, ground] : all_grounds()) {
    const auto line = ground.line(-0.39, 0.39, 1e-8);
    for (int k = 0; k < 100; ++k) {
      const Vec<2> place{std::uniform_real_distribution<double>(-0.2, 0.2)(random),
                         0.07 + std::uniform_real_distribution<double>(0, 0.1)(random)};
      double nearest = 1;
      for (size_t i = 1; i < line.size(); ++i) {
        const Vec<2> d{line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]},
            p{place[0] - line[i - 1][0], place[1] - line[i - 1][1]};
        const double length = d[0] * d[0] + d[1] * d[1];
        const double t = length > 0 ? std::clamp((p[0] * d[0] + p[1] * d[1]) / length, 0.0, 1.0) : 0;
        nearest = std::min(nearest, std::hypot(p[0] - t * d[0], p[1] - t * d[1]));
      }
      EXPECT_NEAR(ground.nearest(place).gap, nearest, 2e-8) << name << " at " << place[0] << ", " << place[1];
    }
  }
}

// A wheel that stands on the ground touches it at one point, with the normal through its centre.
TEST(Ground, AWheelTouchesItWhereItStands) {
  constexpr double radius = 0.34;
  constexpr int n = 200000;
  for (const auto& [name, ground] : all_grounds()) {
    const auto [rise, tilt, curvature] = ground.standing(radius);
    double least = 1, at = 0;
    for (int i = 0; i < n; ++i) {
      const double azimuth = (2.0 * i / n - 1) * 1.5;
      const double gap =
          ground.nearest({radius * std::sin(azimuth), radius + rise - radius * std::cos(azimuth)}).gap;
      if (gap < least) {
        least = gap;
        at = azimuth;
      }
    }
    const double between_points = 1.5 * radius / n;  // at most: of the nearest one from an edge of the ground
    EXPECT_NEAR(least, 0, between_points) << name;
    EXPECT_NEAR(at, tilt, 1e-4) << name;
  }
}

TEST(Ground, ItsCurvatureIsThatWhereTheWheelStands) {
  EXPECT_EQ(Ground().standing(0.34).curvature, 0);
  EXPECT_DOUBLE_EQ(effective_radius(Ground::drum(0.5), 0.34), 1 / (1 / 0.34 + 1 / 0.5));
  EXPECT_DOUBLE_EQ(effective_radius(Ground::internal_drum(0.5), 0.34), 1 / (1 / 0.34 - 1 / 0.5));
  EXPECT_DOUBLE_EQ(effective_radius(Ground::bar(0.01, 0.02, 0.03), 0.34), 1 / (1 / 0.34 + 1 / 0.02));
  EXPECT_DOUBLE_EQ(effective_radius(Ground::kerb(0.4, 0.02, 0), 0.34), 0.34);  // out of reach
  EXPECT_GT(effective_radius(Ground::kerb(0.05, 0.02, 0), 0.34), 0);
}

TEST(Ground, OnlyWhatIsItsOwnMirrorImageIsSymmetric) {
  EXPECT_TRUE(Ground().is_symmetric() && Ground::drum(1).is_symmetric() &&
              Ground::internal_drum(1).is_symmetric() && Ground::bar(0, 0.1, 0.1).is_symmetric());
  for (const auto& [name, ground] : uneven_grounds()) EXPECT_FALSE(ground.is_symmetric()) << name;
}

}  // namespace
}  // namespace wheelwright
