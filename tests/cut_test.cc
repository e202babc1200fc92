#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/cut/cell_quadrature.h"
#include "wheelwright/cut/cut_domain.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/sensitivity/taylor_test.h"
#include "tests/support.h"

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

// Material below a parabola whose vertex lies outside the unit cell: on the edge there its zeros are close to
// each other. The area is a sum of two integrals of a polynomial, which the rule knows exactly.
TEST(Cut, BoundaryThatLeavesTheCellAndComesBackIsIntegratedExactly) {
  const double curvature = 0.8;
  for (const double vertex : {0.29, 0.5, 0.86})
    for (const double half_gap : {0.12, 0.08, 0.03, 0.01}) {
      const auto height = [&](double x) {
        return curvature * ((x - vertex) * (x - vertex) - half_gap * half_gap);
      };
      const auto area_up_to = [&](double x) {  // from a zero
        return curvature * (x * x * x / 3 - half_gap * half_gap * x + 2 * std::pow(half_gap, 3) / 3);
      };
      const double area = area_up_to(vertex) + area_up_to(1 - vertex);
      for (const int axis : {0, 1}) {
        std::vector<double> values;
        for (int a = 0; a < 9; ++a) {
          const auto node = local_node_position<2>(2, a);
          values.push_back(node[1 - axis] / 2.0 - height(node[axis] / 2.0));
        }
        CellQuadrature<2> quadrature(2, 4);
        const auto split = quadrature.split(0, values);
        ASSERT_TRUE(split);
        double sum = 0;
        for (const auto& point : split->material) sum += point.weight;
        EXPECT_NEAR(sum, area, 1e-12) << vertex << ' ' << half_gap << ' ' << axis;
      }
    }
}

// Three cells across a hole: the rule must be so accurate on either side that the integral over the boundary
// is the derivative of the sum over the material.
TEST(Cut, BoundaryIntegralIsTheDerivativeOfTheMeasureOnCoarseGrids) {
  const PolarGrid<2> grid = testing::paper_model(7, 128).grid;
  for (const double centre : {0.26, 0.265, 0.27})
    for (const double radius : {0.0215, 0.0259}) {
      const auto psi = testing::holes(grid, 2, {{centre, 0.5 * grid.sector_angle(), radius}});
      const auto direction = testing::smooth_direction(psi.lattice);
      Evaluation<2> measure{};
      measure.gradient = boundary_samples(psi);
      const double derivative = directional_derivative<2>(measure, psi, direction, 2);
      const auto moved = [&](double t) {
        LevelSet<2> result = psi;
        for (size_t i = 0; i < direction.size(); ++i) result.values[i] += t * direction[i];
        return material_measure(result);
      };
      const double step = 1e-6;
      EXPECT_NEAR((moved(step) - moved(-step)) / (2 * step), derivative, 1e-5 * std::abs(derivative))
          << centre << ' ' << radius;
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
