#include "wheelwright/mechanics/elasticity/fatigue_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "wheelwright/mechanics/elasticity/smooth_ball.h"

namespace wheelwright {
namespace {

using History = std::vector<SymmetricTensor>;
constexpr double pi = std::numbers::pi;
const double root3 = std::sqrt(3.0);

/// Calls visit(name, measure) for every measure.
template <class Visit>
void for_each_measure(Visit visit) {
  visit("principal strain", LargestPrincipal());
  visit("Crossland", Crossland{0.3});
  visit("Dang Van", DangVan{0.3});
  visit("Goodman", Goodman{30});
}

History random_history(unsigned seed, int n, double mean) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  History history(n);
  for (SymmetricTensor& t : history)
    for (int k = 0; k < 6; ++k) t[k] = normal(random) + (k < 3 ? mean : 0);
  return history;
}

SymmetricTensor turned(const SymmetricTensor& t, const std::array<std::array<double, 3>, 3>& q) {
  const double m[3][3] = {{t[0], t[5], t[4]}, {t[5], t[1], t[3]}, {t[4], t[3], t[2]}};
  const auto entry = [&](int i, int j) {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) sum += q[i][a] * m[a][b] * q[j][b];
    return sum;
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(0, 2), entry(0, 1)};
}

TEST(PrincipalAxes, DiagonalizeATensor) {
  for (const SymmetricTensor& t : random_history(1, 20, 0)) {
    const auto values = principal_values(t);
    const auto axes = principal_axes(t);
    const SymmetricTensor diagonal = turned(t, axes);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(diagonal[k], values[k], 1e-12);
    for (int k = 3; k < 6; ++k) EXPECT_NEAR(diagonal[k], 0, 1e-12);
  }
}

/// Uniaxial stress m + a cos: sqrt(J2)_a = a / sqrt(3), p = (m + a) / 3; tau = a / 2 about the center m.
TEST(FatigueMeasures, OfUniaxialStressAreThoseOfItsAmplitudeAndMean) {
  History history;
  const double a = 4, m = 2.5;
  for (int j = 0; j < 24; ++j) history.push_back({m + a * std::cos(2 * pi * j / 24), 0, 0, 0, 0, 0});
  EXPECT_NEAR(Crossland{0.3}.of(history)->value(), a / root3 + 0.3 * (m + a) / 3, 1e-12);
  EXPECT_NEAR(DangVan{0.3}.of(history)->value(), a / 2 + 0.3 * (m + a) / 3, 2e-8);  // a double eigenvalue
  EXPECT_NEAR(Goodman{10}.of(history)->value(), a / (1 - m / 10), 1e-12);
  EXPECT_NEAR(LargestPrincipal().of(history)->value(), m + a, 1e-12);
}

/// Under pressure the mean of a pulsating stress is negative, and does not help.
TEST(FatigueMeasures, OfPulsatingPressureHaveNoGoodmanFactor) {
  const History history{{0, 0, 0, 0, 0, 0}, {-6, 0, 0, 0, 0, 0}};
  EXPECT_NEAR(Goodman{10}.of(history)->value(), 3, 1e-12);
}

/// Torsion c cos: sqrt(J2)_a = c and tau = c without hydrostatic stress; a static shear is no amplitude.
TEST(FatigueMeasures, OfTorsionDoNotDependOnItsMean) {
  for (const double mean : {0.0, 7.0}) {
    History history;
    for (int j = 0; j < 24; ++j) history.push_back({0, 0, 0, 0, 0, mean + 3 * std::cos(2 * pi * j / 24)});
    EXPECT_NEAR(Crossland{0.3}.of(history)->value(), 3, 1e-12);
    EXPECT_NEAR(DangVan{0.3}.of(history)->value(), 3, 1e-12);
    EXPECT_NEAR(Goodman{10}.of(history)->value(), 3 * root3, 1e-12);
  }
}

/// A shear that rotates: out of phase tension and torsion of equal sqrt(J2) move on a circle about 0.
TEST(FatigueMeasures, OfARotatingDeviatorAreItsRadius) {
  History history;
  for (int j = 0; j < 32; ++j) {
    const double t = 2 * pi * j / 32;
    history.push_back({2 * std::cos(t), -2 * std::cos(t), 0, 0, 0, 2 * std::sin(t)});
  }
  EXPECT_NEAR(Crossland{0.3}.of(history)->value(), 2, 1e-12);
  EXPECT_NEAR(DangVan{0.3}.of(history)->value(), 2, 1e-12);
}

TEST(FatigueMeasures, AreTheSameInEveryFrame) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const History history = random_history(seed, 12, 1);
    const auto frame = principal_axes(random_history(seed + 50, 1, 0)[0]);
    History seen;
    for (const SymmetricTensor& t : history) seen.push_back(turned(t, frame));
    for_each_measure([&](const char* name, const auto& measure) {
      EXPECT_NEAR(measure.of(seen)->value(), measure.of(history)->value(), 1e-10) << name;
    });
  }
}

TEST(FatigueMeasures, HaveTheSlopesOfTheirDifferences) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const int n : {1, 2, 3, 12}) {
      const History history = random_history(seed, n, 1), direction = random_history(seed + 99, n, 0);
      std::vector<double> factors;
      for (int j = 0; j < n; ++j) factors.push_back(j % 3);  // also 0
      for_each_measure([&](const char* name, const auto& measure) {
        const auto of_samples = measure.of(history)->slopes(factors);
        double slope = 0;
        for (int j = 0; j < n; ++j)
          for (int k = 0; k < 6; ++k) slope += of_samples[j][k] * direction[j][k];
        const auto at = [&](double h) {
          History moved = history;
          for (int j = 0; j < n; ++j)
            for (int k = 0; k < 6; ++k) moved[j][k] += h * direction[j][k];
          const auto samples = measure.of(moved)->samples();
          return std::inner_product(samples.begin(), samples.end(), factors.begin(), 0.0);
        };
        constexpr double h = 1e-6;
        EXPECT_NEAR((at(h) - at(-h)) / (2 * h), slope, 1e-6 * (1 + std::abs(slope)))
            << name << ", seed " << seed << ", " << n << " samples";
      });
    }
}

/// Up to what makes them smooth.
TEST(FatigueMeasures, AreTheLargestOfTheirSamples) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const History history = random_history(seed, 12, 1);
    for_each_measure([&](const char* name, const auto& measure) {
      const double largest = std::ranges::max(measure.of(history)->samples());
      EXPECT_NEAR(largest / measure.of(history)->value(), 1, 0.05) << name;
    });
  }
}

/// What may be 0 is only what is less.
TEST(FatigueMeasures, AreKnownFromALeastSampleOn) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    History history = random_history(seed, 12, 1);
    for (int j = 0; j < 12; ++j)
      for (double& x : history[j]) x *= j < 3 ? 1 : 0.3;  // samples of all sizes
    for_each_measure([&](const char* name, const auto& measure) {
      const auto exact = measure.of(history);
      const auto samples = exact->samples();
      for (const double share : {0.2, 0.5, 0.9, 1.0, 1.2, 2.0}) {
        const double least = share * exact->value();
        const auto from_least = measure.of(history, least);
        if (share < 1) {
          EXPECT_EQ(from_least->value(), exact->value()) << name << ", seed " << seed;
        }
        const auto found = from_least->samples();
        std::vector<double> factors;
        for (int j = 0; j < 12; ++j) {
          EXPECT_TRUE(found[j] == samples[j] || (found[j] == 0 && samples[j] < least)) << name;
          factors.push_back(samples[j] < least ? 0 : 1 + j);
        }
        if (share < 1) {
          EXPECT_EQ(from_least->slopes(factors), exact->slopes(factors)) << name;
        }
      }
    });
  }
}

TEST(SmallestBall, ContainsAllPointsAndTouchesSome) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int n : {1, 2, 7, 60}) {
    std::vector<SmallestBall::Point> points(n);
    for (auto& point : points)
      for (double& x : point) x = normal(random);
    points.push_back(points.front());  // as symmetric histories have them twice
    const SmallestBall ball(points);
    double largest = 0;
    for (const auto& point : points) {
      double square = 0;
      for (int k = 0; k < 5; ++k) square += std::pow(point[k] - ball.center()[k], 2);
      largest = std::max(largest, std::sqrt(square));
    }
    EXPECT_NEAR(largest, ball.radius(), 1e-12);
    // No other center is better.
    for (int k = 0; k < 20; ++k) {
      SmallestBall::Point other = ball.center();
      for (double& x : other) x += 0.01 * normal(random);
      double radius = 0;
      for (const auto& point : points) {
        double square = 0;
        for (int i = 0; i < 5; ++i) square += std::pow(point[i] - other[i], 2);
        radius = std::max(radius, std::sqrt(square));
      }
      EXPECT_GE(radius, ball.radius() * (1 - 1e-12));
    }
  }
}

/// Its points are those of many samples near each other and of a few others, as those of a turn.
TEST(SmoothBall, IsNearTheSmallestOneAndHasTheSlopesOfItsDifferences) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  using Points = std::vector<SmallestBall::Point>;
  const auto moved = [](Points points, double h, const Points& direction) {
    for (std::size_t j = 0; j < points.size(); ++j)
      for (int k = 0; k < 5; ++k) points[j][k] += h * direction[j][k];
    return points;
  };
  for (const int n : {2, 3, 7, 60, 300}) {
    Points points(n), direction(n);
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < 5; ++k) {
        points[j][k] = (j < 5 ? 1 : 0.01) * normal(random);
        direction[j][k] = normal(random);
      }
    const auto of = [](const Points& x) { return SmoothBall(x, SmallestBall(x)); };
    const SmoothBall ball = of(points);
    const double smallest = SmallestBall(points).radius();
    EXPECT_GE(ball.radius(), smallest);
    EXPECT_LE(ball.radius(), smallest * std::pow(n, 1.0 / 64));
    constexpr double h = 1e-6;
    const SmoothBall ahead = of(moved(points, h, direction)), behind = of(moved(points, -h, direction));
    SmallestBall::Point a;
    for (double& x : a) x = normal(random);
    const auto of_radius = ball.slopes_of_radius(), of_center = ball.slopes_of_center(a);
    double radius_slope = 0, center_slope = 0, center_difference = 0;
    for (int k = 0; k < 5; ++k) {
      center_difference += a[k] * (ahead.center()[k] - behind.center()[k]) / (2 * h);
      for (int j = 0; j < n; ++j) {
        radius_slope += of_radius[j][k] * direction[j][k];
        center_slope += of_center[j][k] * direction[j][k];
      }
    }
    EXPECT_NEAR((ahead.radius() - behind.radius()) / (2 * h), radius_slope, 1e-7) << n;
    EXPECT_NEAR(center_difference, center_slope, 1e-5 * (1 + std::abs(center_slope))) << n;
  }
}

}  // namespace
}  // namespace wheelwright
