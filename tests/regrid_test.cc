#include "wheelwright/shape/evolution/regrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/values_on.h"

// A shape on another grid of the same ring.

namespace wheelwright::testing {
namespace {

using std::numbers::pi;

PolarGrid<2> ring(int sectors, int radial_cells, int ring_columns) {
  return {0.2, 0.34, 0.12, sectors, {radial_cells, ring_columns / sectors}};
}

/// Round holes at two radii, of which no sector is its own mirror image.
LevelSet<2> uneven(const PolarGrid<2>& grid, int degree) {
  const double sector = grid.sector_angle();
  return holes(grid, degree, {{0.25, 0.3 * sector, 0.02}, {0.29, 0.7 * sector, 0.025}});
}

/// A trigonometric function of period `sectors` with the values and the period of a level set, at the nodes.
template <int dim>
LevelSet<dim> wave(const Lattice<dim>& lattice, int sectors) {
  LevelSet<dim> psi{lattice, {}};
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<dim> x = lattice.polar_point(i);
    double value = std::sin(40 * x[0]) + std::cos(sectors * x[1]) + 0.3 * std::sin(2 * sectors * x[1] + 1);
    if constexpr (dim == 3) value += std::sin(9 * x[2]);
    psi.values.push_back(value);
  }
  return psi;
}

TEST(Regrid, NodesThatAreThereKeepTheirValuesToTheLastBit) {
  const LevelSet<2> psi = uneven(ring(8, 14, 128), 2);
  EXPECT_EQ(regrid(psi, psi.lattice).values, psi.values);
  const LevelSet<2> wide = regrid(psi, Lattice<2>(ring(2, 14, 128), 2));
  for (int i = 0; i < wide.lattice.n_nodes(); ++i)
    EXPECT_EQ(wide.values[i], psi.values[i % psi.lattice.n_nodes()]);
}

TEST(Regrid, APolynomialOfTheCoarseCellsIsTheSameOnNestedGrids) {
  for (const int degree : {1, 2}) {
    const LevelSet<2> coarse = wave(Lattice<2>(ring(8, 6, 64), degree), 8);
    const LevelSet<2> fine = values_on(coarse, Lattice<2>(ring(4, 18, 192), degree));
    for (int k = 0; k < 500; ++k) {
      const Vec<2> at{0.2 + 0.14 * std::fmod(0.618 * k, 1.0), 7 * std::fmod(0.414 * k, 1.0)};
      EXPECT_NEAR(value_at<2>(fine, at), value_at<2>(coarse, at), 1e-13);
    }
  }
}

TEST(Regrid, InThreeDimensionsToo) {
  const Lattice<3> coarse({0.2, 0.34, 0.12, 8, {4, 6, 2}}, 2), fine({0.2, 0.34, 0.12, 4, {8, 24, 6}}, 2);
  const LevelSet<3> psi = wave(coarse, 8), moved = values_on(psi, fine);
  for (int k = 0; k < 200; ++k) {
    const Vec<3> at{0.2 + 0.14 * std::fmod(0.618 * k, 1.0), 7 * std::fmod(0.414 * k, 1.0),
                    0.12 * std::fmod(0.732 * k, 1.0)};
    EXPECT_NEAR(value_at<3>(moved, at), value_at<3>(psi, at), 1e-13);
  }
}

TEST(Regrid, ValuesConvergeWithTheDegreeOfTheShape) {
  const Lattice<2> target(ring(8, 17, 120), 2);
  for (const int degree : {1, 2}) {
    double error[2] = {0, 0};
    for (const int fine : {0, 1}) {
      const int n = fine ? 2 : 1;
      const LevelSet<2> moved = values_on(wave(Lattice<2>(ring(8, 20 * n, 256 * n), degree), 8), target);
      const LevelSet<2> exact = wave(target, 8);
      for (int i = 0; i < target.n_nodes(); ++i)
        error[fine] = std::max(error[fine], std::abs(moved.values[i] - exact.values[i]));
    }
    EXPECT_GT(std::log2(error[0] / error[1]), degree + 0.8);
  }
}

TEST(Regrid, TheAreaOfAnUnevenWheelConverges) {
  double error[2] = {0, 0};
  for (const int fine : {0, 1}) {
    const int n = fine ? 2 : 1;
    const LevelSet<2> psi = uneven(ring(8, 14 * n, 256 * n), 2);
    const LevelSet<2> moved = regrid(psi, Lattice<2>(ring(8, 18 * n, 320 * n), 2));
    const double area = pi * (0.34 * 0.34 - 0.2 * 0.2) / 8 - pi * (0.02 * 0.02 + 0.025 * 0.025);
    error[fine] = std::abs(material_measure(moved) - area) / area;
  }
  EXPECT_LT(error[0], 2e-4);
  EXPECT_GT(std::log2(error[0] / error[1]), 1.9);
}

TEST(Regrid, AMirrorSymmetricShapeStaysSo) {
  const LevelSet<2> psi = paper_holes(ring(16, 14, 256));
  ASSERT_TRUE(is_mirror_symmetric(psi));
  EXPECT_TRUE(is_mirror_symmetric(regrid(psi, Lattice<2>(ring(16, 21, 320), 2))));
  EXPECT_FALSE(is_mirror_symmetric(regrid(uneven(ring(8, 14, 128), 2), Lattice<2>(ring(8, 21, 160), 2))));
}

TEST(Regrid, OnlyTheSameRingAndDivisorsOfItsSectorsFit) {
  const PolarGrid<2> grid = ring(12, 14, 144);
  for (const int sectors : {1, 2, 3, 4, 6, 12}) EXPECT_EQ(misfit(grid, ring(sectors, 28, 144)), "");
  for (const int sectors : {5, 8, 24}) EXPECT_NE(misfit(grid, ring(sectors, 28, 240)), "");
  PolarGrid<2> other = grid;
  other.width = 0.3;
  EXPECT_EQ(misfit(grid, other), "");
  other.inner_radius = 0.2001;
  EXPECT_NE(misfit(grid, other), "");
  const PolarGrid<3> solid{0.2, 0.34, 0.12, 12, {14, 12, 2}}, wider{0.2, 0.34, 0.13, 12, {14, 12, 2}};
  EXPECT_EQ(misfit(solid, solid), "");
  EXPECT_NE(misfit(solid, wider), "");
}

}  // namespace
}  // namespace wheelwright::testing
