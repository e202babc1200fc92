#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cut/cut_domain.h"
#include "cut/measure.h"

namespace wheelwright {
namespace {

LevelSet<2> one_hole(int radial, int columns, double radius, double centre_r, double azimuth, int degree) {
  const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {radial, columns}};
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  const double sector = grid.sector_angle();
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> p = psi.lattice.polar_point(i);
    double value = -1;
    for (int image = -1; image <= 1; ++image) {
      const double a = p[1] - azimuth - image * sector;
      const double distance =
          std::sqrt(p[0] * p[0] + centre_r * centre_r - 2 * p[0] * centre_r * std::cos(a));
      value = std::max(value, radius - distance);
    }
    psi.values.push_back(value);
  }
  return psi;
}

TEST(Cut, AreaAndPerimeterOfTheHoles) {
  const double sector = std::numbers::pi / 8;
  for (double azimuth : {0.5 * sector, 0.0, 0.3 * sector}) {
    const auto psi = one_hole(16, 12, 0.04, 0.27, azimuth, 2);
    const double ring = std::numbers::pi / 16 * (0.34 * 0.34 - 0.2 * 0.2);
    const double hole = std::numbers::pi * 0.04 * 0.04;
    EXPECT_NEAR(material_measure(psi), ring - hole, 1e-5 * hole);
    double perimeter = 0;
    Vec<2> closed{};
    for (const auto& s : boundary_samples(psi)) {
      perimeter += s.weight;
      for (int d = 0; d < 2; ++d) closed[d] += s.weight * s.normal[d];
      EXPECT_NEAR(norm<2>(s.normal), 1, 1e-12);
    }
    EXPECT_NEAR(perimeter, 2 * std::numbers::pi * 0.04, 1e-5 * perimeter);
    if (azimuth == 0.5 * sector) {
      EXPECT_LT(norm<2>(closed), 1e-6 * perimeter);
    }
  }
}

TEST(Cut, IslandsAndNansAreFailures) {
  auto psi = one_hole(16, 12, 0.04, 0.27, std::numbers::pi / 16, 2);
  ASSERT_TRUE(cut_domain(psi, 3));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> x = cartesian<2>(psi.lattice.polar_point(i));
    const Vec<2> c = cartesian<2>({0.27, std::numbers::pi / 16});
    psi.values[i] = std::max(std::min(psi.values[i], std::hypot(x[0] - c[0], x[1] - c[1]) - 0.012), -1.0);
  }
  const auto island = cut_domain(psi, 3);
  ASSERT_TRUE(island);
  const auto failure = check_attached(*island, 1, 2);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->reason, FailureReason::disconnected_material);
  psi.values[10] = std::nan("");
  const auto nan = cut_domain(psi, 3);
  ASSERT_FALSE(nan);
  EXPECT_EQ(nan.failure().reason, FailureReason::not_finite);
}

}  // namespace
}  // namespace wheelwright
