#include "wheelwright/shape/cut/critical_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "wheelwright/base/vec.h"

namespace wheelwright {
namespace {

/// psi = (x - m) . Q (x - m) - level on the unit cell: a quadric about the middle m.
struct Quadric {
  Mat<3> form;
  Vec<3> middle;
  double level;

  double operator()(const Vec<3>& x) const {
    double sum = -level;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += (x[i] - middle[i]) * form[i][j] * (x[j] - middle[j]);
    return sum;
  }

  BernsteinForm<3> in_cell() const {
    std::vector<double> nodal;
    for (int a = 0; a < 27; ++a) nodal.push_back((*this)({0.5 * (a % 3), 0.5 * (a / 3 % 3), 0.5 * (a / 9)}));
    return {2, nodal};
  }

  /// Planes across an axis touch the quadric at these points, m +- s Q^-1 e with s^2 e . Q^-1 e = level.
  std::vector<Vec<3>> touching_points(int axis) const {
    const Mat<3> inverted = inverse<3>(form);
    const double square = level / inverted[axis][axis];
    if (square < 0) return {};
    std::vector<Vec<3>> points(2, middle);
    for (int i = 0; i < 3; ++i) {
      points[0][i] -= std::sqrt(square) * inverted[i][axis];
      points[1][i] += std::sqrt(square) * inverted[i][axis];
    }
    return points;
  }
};

/// Ellipsoids, hyperboloids and saddles in any position.
Quadric random_quadric(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  Quadric q{{}, {}, normal(random) * std::pow(10.0, -2 * uniform(random))};
  for (int i = 0; i < 3; ++i) {
    q.middle[i] = 2 * uniform(random) - 0.5;
    for (int j = 0; j <= i; ++j) q.form[i][j] = q.form[j][i] = normal(random);
  }
  return q;
}

TEST(CriticalPlaces, AreThoseWherePlanesTouchAQuadric) {
  std::mt19937_64 random(5);
  int found_one = 0, found_two = 0;
  for (int k = 0; k < 20000; ++k) {
    const Quadric quadric = random_quadric(random);
    if (std::abs(determinant<3>(quadric.form)) < 1e-2) continue;
    const std::array<int, 3> axes{(k + 1) % 3, (k + 2) % 3, k % 3};
    std::vector<double> expected;
    bool is_clear = true;  // no point at the cell's faces, and no two that nearly are one
    for (const Vec<3>& point : quadric.touching_points(axes[2])) {
      double inside = 1;
      for (const double x : point) inside = std::min({inside, x, 1 - x});
      if (std::abs(inside) < 1e-3) is_clear = false;
      if (inside > 0) expected.push_back(point[axes[2]]);
    }
    std::ranges::sort(expected);
    if (expected.size() == 2 && expected[1] - expected[0] < 1e-2) is_clear = false;
    if (!is_clear) continue;
    const auto found = critical_places(quadric.in_cell(), axes);
    ASSERT_EQ(found.size(), expected.size()) << k;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << k;
    found_one += expected.size() == 1;
    found_two += expected.size() == 2;
  }
  EXPECT_GT(found_one, 500);
  EXPECT_GT(found_two, 100);
}

}  // namespace
}  // namespace wheelwright
