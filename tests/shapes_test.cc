#include "wheelwright/shape/geometry/shapes.h"

#include <gtest/gtest.h>

#include <random>

using namespace wheelwright;

namespace {

constexpr double pi = std::numbers::pi;
const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {28, 24}};

/// The distance to the nearest edge among all holes of the full ring, from Cartesian coordinates.
double brute_force(std::span<const Circle> holes, const Vec<2>& polar) {
  double result = -1e300;
  const Vec<2> x = cartesian<2>(polar);
  for (const Circle& hole : holes)
    for (int sector = 0; sector < grid.n_sectors; ++sector) {
      const Vec<2> c = cartesian<2>({hole.centre_radius, hole.centre_azimuth + sector * grid.sector_angle()});
      result = std::max(result, hole.hole_radius - std::hypot(x[0] - c[0], x[1] - c[1]));
    }
  return result;
}

TEST(SignedDistance, IsTheDistanceToTheNearestImageOfAnyHole) {
  const std::vector<Circle> holes{{0.27, 0.02, 0.03}, {0.31, 0.35, 0.01}, {0.23, -1.0, 0.012}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(0.2, 0.34), azimuth(-4, 8);
  for (int k = 0; k < 500; ++k) {
    const Vec<2> polar{radius(random), azimuth(random)};
    EXPECT_NEAR(signed_distance<2>(grid, holes, polar), brute_force(holes, polar), 1e-14);
  }
}

TEST(SignedDistance, IsPositiveInAHoleAndPeriodic) {
  const std::vector<Circle> holes{{0.27, 0, 0.04}};
  EXPECT_NEAR(signed_distance<2>(grid, holes, {0.27, 0}), 0.04, 1e-15);
  EXPECT_NEAR(signed_distance<2>(grid, holes, {0.27, 5 * pi / 8}), 0.04, 1e-15);
  EXPECT_NEAR(signed_distance<2>(grid, holes, {0.22, 0}), -0.01, 1e-15);
}

TEST(LevelSetOfHoles, IsNegativeEverywhereWithoutHoles) {
  for (double value : make_level_set(Lattice<2>(grid, 1), {}).values) EXPECT_LT(value, 0);
}

TEST(LevelSetOfHoles, IsConstantAlongTheAxleInThreeDimensions) {
  const std::vector<Circle> holes{{0.27, 0.1, 0.03}};
  const PolarGrid<3> thick{0.20, 0.34, 0.12, 16, {6, 5, 3}};
  const auto flat = make_level_set(Lattice<2>({0.20, 0.34, 0.12, 16, {6, 5}}, 2), holes);
  const auto psi = make_level_set(Lattice<3>(thick, 2), holes);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    const auto p = psi.lattice.node_position(node);
    EXPECT_EQ(psi.values[node], flat.values[flat.lattice.node_index({p[0], p[1]})]);
  }
}

}  // namespace
