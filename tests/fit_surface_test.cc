#include "wheelwright/output/export/fit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/output/report/workshop_surface.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

constexpr double any_distance = 1;  // [m]

LevelSet<3> ring_without_holes(const PolarGrid<3>& grid, int degree) {
  return {Lattice<3>(grid, degree), std::vector<double>(Lattice<3>(grid, degree).n_nodes(), -1.0)};
}

/// A regular polygon with `n` sides lacks this share of the area of its circle.
double lack_of_polygon(int n) { return 1 - std::sin(2 * pi / n) / (2 * pi / n); }

TEST(FitSurface, WithoutHolesHasAsManyChordsAsTheVolumeNeeds) {
  for (const int columns : {7, 11, 17}) {
    const PolarGrid<3> grid{0.33, 0.34, 0.12, 5, {2, columns, 1}};
    const auto fitted = fit_surface(ring_without_holes(grid, 2), 2, any_distance);
    ASSERT_TRUE(fitted) << fitted.failure().what;
    EXPECT_LT(std::abs(fitted->volume_error), 1e-3);
    // The parabolas of the cells differ from circles by less than 1e-5 of the area.
    const int n = grid.ring_columns();
    EXPECT_NEAR(fitted->volume_error, -lack_of_polygon(n * fitted->parts), 1e-5) << columns;
    EXPECT_EQ(fitted->parts > 1, lack_of_polygon(n) > 1e-3) << columns;
    // Fewer chords are too few.
    if (fitted->parts > 1) EXPECT_GT(lack_of_polygon(n * (fitted->parts - 1)), 1e-3) << columns;
  }
}

TEST(FitSurface, OfCellsWithStraightSidesIsExactWithOneCubePerCell) {
  const auto fitted = fit_surface(ring_without_holes({0.2, 0.34, 0.12, 5, {2, 3, 1}}, 1), 1, any_distance);
  ASSERT_TRUE(fitted) << fitted.failure().what;
  EXPECT_EQ(fitted->parts, 1);
  EXPECT_LT(std::abs(fitted->volume_error), 1e-6);  // single precision of the points
}

TEST(FitSurface, KeepsItsDistanceAndItsVolume) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 5, {7, 11, 2}};
  const Circle hole{0.27, 0.37 * grid.sector_angle(), 0.04};
  const auto psi = make_level_set<3>(Lattice<3>(grid, 2), std::span(&hole, 1));
  for (const double tolerance : {1e-2, 1e-3, 3e-4}) {
    const auto fitted = fit_surface(psi, 2, tolerance);
    ASSERT_TRUE(fitted) << fitted.failure().what;
    EXPECT_LE(fitted->deviation, tolerance);
    EXPECT_LT(std::abs(fitted->volume_error), 1e-3) << tolerance;
  }
}

TEST(FitSurface, RefusesCellsWhoseParabolasNeedMoreChords) {
  // 8 chords for each of 5 cells around the ring are 0.41 % too small.
  EXPECT_FALSE(fit_surface(ring_without_holes({0.2, 0.34, 0.12, 5, {2, 1, 1}}, 2), 2, any_distance));
}

/// The cells are few and long. A wall in the middle of the width connects a rim and a tread.
LevelSet<3> thin_wall(double thickness) {
  const PolarGrid<3> grid{0.0145, 0.034, 0.0168, 16, {9, 3, 3}};
  LevelSet<3> psi{Lattice<3>(grid, 2), {}};
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    const Vec<3> x = psi.lattice.polar_point(node);
    psi.values.push_back(
        std::min(0.006 - std::abs(x[0] - 0.023), std::abs(x[2] - 0.5 * grid.width) - 0.5 * thickness));
  }
  return psi;
}

TEST(WorkshopSurface, HasTheVolumeWhereThatOfPicturesIsTooCoarse) {
  for (const int degree : {1, 2}) {
    const auto psi = thin_wall(0.003);
    const SurfaceMesh of_pictures = shape_boundary(psi, degree);
    const double volume = 16 * material_measure(*cut_domain(psi, 4), degree);
    const auto error = [&](const SurfaceMesh& surface) {
      return std::abs(enclosed_volume(surface) / volume - 1);
    };
    EXPECT_GT(error(of_pictures), 0.01);
    EXPECT_LE(error(workshop_surface(of_pictures, psi, degree)), 0.01);
  }
  const auto solid = ring_without_holes({0.2, 0.34, 0.12, 5, {2, 11, 1}}, 2);
  const SurfaceMesh of_pictures = shape_boundary(solid, 2);
  EXPECT_EQ(workshop_surface(of_pictures, solid, 2).triangles, of_pictures.triangles);
}

}  // namespace
}  // namespace wheelwright
