#include "wheelwright/cad/outline/spline_parts.h"

#include <gtest/gtest.h>

#include <numbers>

#include "wheelwright/cad/outline/spline_fit.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright::cad {
namespace {

using std::numbers::pi;

/// A window of 120 x 60 mm with rounded corners, |x / a|^8 + |y / b|^8 = 1, as a closed spline within 0.01
/// mm.
Spline fitted_window() {
  constexpr double spacing = 6e-4;
  std::vector<Vec<2>> points{{0.33, 0}};
  for (double angle = 0; angle < 2 * pi; angle += 1e-4) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double r = std::pow(std::pow(c / 0.06, 8) + std::pow(s / 0.03, 8), -1.0 / 8);
    const Vec<2> point{0.27 + r * c, r * s};
    if (norm(point - points.back()) >= spacing) points.push_back(point);
  }
  const auto spline = fit_spline(points, true, 1e-5);
  EXPECT_TRUE(spline);
  return *spline;
}

const Spline& window() {
  static const Spline once = fitted_window();
  return once;
}

int n_cubics(const Spline& spline) { return static_cast<int>(spline.points.size()) - 3; }

TEST(SplineParts, ErrorIsThatOfTheRuleOnTheWholeCurve) {
  const Spline& spline = window();
  const GaussRule rule = gauss_rule(61);
  Vec<2> led{};
  for (int q = 0; q < 61; ++q) led += rule.weights[q] * at(spline, rule.points[q]).velocity;
  const Vec<2> missed = led - (end_of(spline) - start_of(spline));
  EXPECT_NEAR(usual_error(spline, 0, n_cubics(spline)), norm(missed), 1e-12);
  EXPECT_GT(norm(missed), 1e-4);  // the rule has too few points for the corners
}

TEST(SplineParts, SmallNumbersOfPointsAreEightPerCubic) {
  EXPECT_EQ(usual_points(1), 8);
  EXPECT_EQ(usual_points(7), 56);
  EXPECT_EQ(usual_points(8), 61);
  EXPECT_EQ(usual_points(100), 61);
}

TEST(SplineParts, OneCubicIsIntegratedExactly) {
  const Spline& spline = window();
  for (int i = 0; i < n_cubics(spline); ++i) EXPECT_LT(usual_error(spline, i, i + 1), 1e-15);
}

TEST(SplineParts, CoverTheSplineAndKeepTheTolerance) {
  const Spline& spline = window();
  for (const double tolerance : {1e-7, 1e-6, 1e-5}) {
    const auto ends = spline_parts(spline, tolerance);
    EXPECT_EQ(ends.front(), 0);
    EXPECT_EQ(ends.back(), n_cubics(spline));
    for (size_t i = 1; i < ends.size(); ++i) {
      EXPECT_LT(ends[i - 1], ends[i]);
      EXPECT_LE(usual_error(spline, ends[i - 1], ends[i]), tolerance);
    }
  }
  EXPECT_EQ(spline_parts(spline, 1), (std::vector{0, n_cubics(spline)}));
}

/// Compares with all divisions of a spline of twelve cubics with one sharp bend.
TEST(SplineParts, AreTheFewestWithTheSmallestErrors) {
  Spline spline{{0, 0, 0}, {}};
  constexpr int n = 12;
  for (int i = 0; i <= n; ++i) spline.knots.push_back(i < 6 ? i : i + 5);
  spline.knots.insert(spline.knots.end(), 3, spline.knots.back());
  for (int i = 0; i < n + 3; ++i)
    spline.points.push_back({i < 7 ? i : 7.0 + 0.1 * (i % 3), i < 7 ? 0.0 : i * i * 0.3});
  for (const double tolerance : {1e-4, 1e-3, 1e-2, 1e-1}) {
    size_t fewest = 1000;
    double least = 0;
    for (int cuts = 0; cuts < 1 << (n - 1); ++cuts) {
      std::vector<int> ends{0};
      for (int k = 1; k < n; ++k)
        if (cuts >> (k - 1) & 1) ends.push_back(k);
      ends.push_back(n);
      double sum = 0;
      bool keeps = true;
      for (size_t i = 1; i < ends.size(); ++i) {
        const double error = usual_error(spline, ends[i - 1], ends[i]);
        keeps = keeps && (error <= tolerance || ends[i] - ends[i - 1] == 1);
        sum += error;
      }
      if (!keeps || ends.size() > fewest || (ends.size() == fewest && sum >= least)) continue;
      fewest = ends.size();
      least = sum;
    }
    const auto found = spline_parts(spline, tolerance);
    double sum = 0;
    for (size_t i = 1; i < found.size(); ++i) sum += usual_error(spline, found[i - 1], found[i]);
    EXPECT_EQ(found.size(), fewest);
    EXPECT_NEAR(sum, least, 1e-12);
  }
}

}  // namespace
}  // namespace wheelwright::cad
