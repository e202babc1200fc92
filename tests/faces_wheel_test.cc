#include "wheelwright/run/results/faces_wheel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/output/export/fit_surface.h"
#include "wheelwright/shape/geometry/shapes.h"
#include "wheelwright/shape/surface/zero_surface.h"

namespace wheelwright {
namespace {

const PolarGrid<3> ring{0.20, 0.34, 0.12, 5, {7, 11, 2}};

SurfaceModel wheel_with_cylinders(int degree, double tolerance) {
  const Circle hole{0.27, 0.37 * ring.sector_angle(), 0.04};
  const auto psi = make_level_set<3>(Lattice<3>(ring, degree), std::span(&hole, 1));
  auto fitted = fit_surface(psi, degree, tolerance);
  EXPECT_TRUE(fitted) << fitted.failure().what;
  return {"wheel", "test", psi, std::move(fitted->surface), fitted->parts, degree};
}

/// Level sets are polynomials in polar coordinates, so that the edges of cells of degree 1, which are chords,
/// deviate from them by the height of an arc.
TEST(FacesWheel, FacetsStayWithinAToleranceBelowTheHeightOfAColumnsArc) {
  const double column = 2 * std::numbers::pi / ring.ring_columns();
  const double height = 0.31 * (1 - std::cos(column / 2));
  for (const int degree : {1, 2})
    for (const double share : {0.8, 0.5}) {
      const double tolerance = share * height;
      const SurfaceModel wheel = wheel_with_cylinders(degree, tolerance);
      const auto faces = fitted_faces_wheel(wheel, FaceKind::facets, tolerance);
      ASSERT_TRUE(faces) << faces.failure().front().what;
      EXPECT_LE(faces->deviation, tolerance);
      const auto& solid = std::get<FacetedSolid>(faces->model.solid);
      EXPECT_TRUE(solid.has_rim_cylinder && solid.has_tread_cylinder);
      const ZeroSurface zero(wheel.shape);
      double largest = 0, area = 0;
      for (const auto& [corners, shell] : solid.triangles) {
        const Vec<3>&a = solid.points[corners[0]], &b = solid.points[corners[1]],
              &c = solid.points[corners[2]];
        area += 0.5 * norm(cross(b - a, c - a));
        for (const Vec<3>& weight : {Vec<3>{0.6, 0.3, 0.1}, Vec<3>{0.1, 0.45, 0.45}, Vec<3>{0, 0.4, 0.6}})
          largest = std::max(largest, zero.at(weight[0] * a + weight[1] * b + weight[2] * c).distance());
      }
      EXPECT_LE(largest, 1.05 * tolerance) << "degree " << degree;
      EXPECT_GT(largest, 0.1 * tolerance) << "degree " << degree;
      // A surface that is nowhere farther away encloses no other volume than this.
      EXPECT_LT(std::abs(faces->volume_error) * faces->volume, 2 * tolerance * area);
    }
}

}  // namespace
}  // namespace wheelwright
