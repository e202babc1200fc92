#include "wheelwright/cad/solid/lofted_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "wheelwright/shape/geometry/shapes.h"
#include "wheelwright/shape/surface/check_surface.h"
#include "wheelwright/shape/surface/simplified_surface.h"
#include "wheelwright/shape/surface/zero_surface.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

/// Half of a torus around an axis beside the axle: u around it, v from 0 to 1.
Vec<3> torus(double u, double v) {
  const double around = 2 * pi * u, across = pi * (v - 0.3), r = 0.2 + 0.05 * std::cos(across);
  return {0.1 + r * std::cos(around), r * std::sin(around),
          0.05 * std::sin(across) + 0.02 * std::sin(2 * around)};
}

cad::SplineSurface interpolated_torus(int columns, int rows) {
  std::vector<Vec<3>> points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j <= rows; ++j) points.push_back(torus(double(i) / columns, double(j) / rows));
  return cad::interpolated(points, columns, rows);
}

TEST(SplineSurface, PassesItsPointsAndConvergesWithOrderFour) {
  const auto error = [](int n) {
    const auto surface = interpolated_torus(2 * n, n);
    double largest = 0;
    for (int i = 0; i < 4 * n; ++i)
      for (int j = 0; j <= 2 * n; ++j) {
        const double found = norm(at(surface, 0.5 * i, 0.5 * j).position - torus(0.25 * i / n, 0.5 * j / n));
        if (i % 2 == 0 && j % 2 == 0) {
          EXPECT_LT(found, 1e-12);
        }
        largest = std::max(largest, found);
      }
    return largest;
  };
  EXPECT_GT(std::log2(error(8) / error(16)), 3.5);
}

TEST(SplineSurface, HasItsDerivativesAndCloses) {
  const auto surface = interpolated_torus(13, 7);
  constexpr double step = 1e-5;
  for (const auto& [u, v] : {Vec<2>{0.3, 0.4}, Vec<2>{12.7, 6.8}, Vec<2>{5.5, 3.2}, Vec<2>{8.1, 1.5}}) {
    const cad::SurfaceJet jet = at(surface, u, v);
    const auto position = [&](double du, double dv) { return at(surface, u + du, v + dv).position; };
    EXPECT_LT(norm(jet.by_u - (position(step, 0) - position(-step, 0)) / (2 * step)), 1e-8);
    EXPECT_LT(norm(jet.by_v - (position(0, step) - position(0, -step)) / (2 * step)), 1e-8);
  }
  EXPECT_LT(norm(at(surface, 13 - 1e-9, 2.5).by_u - at(surface, 0, 2.5).by_u), 1e-9);
}

template <class Function>
LevelSet<3> level_set(const PolarGrid<3>& grid, int degree, const Function& psi) {
  LevelSet<3> result{Lattice<3>(grid, degree), {}};
  for (int node = 0; node < result.lattice.n_nodes(); ++node)
    result.values.push_back(psi(result.lattice.polar_point(node)));
  return result;
}

/// A hole through the wheel that widens along the axle; without mirror symmetry.
LevelSet<3> cone(const PolarGrid<3>& grid) {
  return level_set(grid, 2, [&](const Vec<3>& polar) {
    const Vec<3> x = cartesian<3>(polar), centre = cartesian<3>({0.27, 0.37 * grid.sector_angle(), 0});
    return 0.02 + 0.1 * x[2] - std::hypot(x[0] - centre[0], x[1] - centre[1]);
  });
}

const PolarGrid<3> ring{0.20, 0.34, 0.12, 5, {14, 22, 4}};

TEST(SimplifiedSurface, StaysWithinTheToleranceWithFarFewerTriangles) {
  const LevelSet<3> psi = cone(ring);
  const SurfaceMesh mesh = material_surface(psi, 3, 2);
  const double tolerance = 4e-4;
  const SurfaceMesh fewer = simplified(mesh, psi, tolerance);
  EXPECT_LT(20 * fewer.triangles.size(), mesh.triangles.size());
  const auto report = check_surface(fewer.points, fewer.triangles);
  ASSERT_TRUE(report) << report.failure().what;
  EXPECT_EQ(report->handles(), 1 + ring.n_sectors);
  const ZeroSurface zero(psi);
  for (std::size_t t = 0; t < fewer.triangles.size(); ++t) {
    if (fewer.parts[t] != SurfacePart::hole) continue;
    const auto& [a, b, c] = fewer.triangles[t];
    EXPECT_LE(zero.at((fewer.points[a] + fewer.points[b] + fewer.points[c]) / 3.0).distance(), tolerance);
    EXPECT_LE(zero.at(0.5 * (fewer.points[a] + fewer.points[b])).distance(), 1.2 * tolerance);
  }
}

TEST(SimplifiedSurface, IsAManifoldForRandomLevelSets) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const int sectors : {1, 2, 5}) {
    const PolarGrid<3> grid{0.20, 0.34, 0.12, sectors, {4, 7, 3}};
    const auto psi = level_set(grid, 1, [&](const Vec<3>&) { return 0.02 * value(random); });
    const SurfaceMesh mesh = material_surface(psi, 2, 2);
    const SurfaceMesh fewer = simplified(mesh, psi, 0.005);
    EXPECT_LT(fewer.triangles.size(), mesh.triangles.size());
    const auto before = check_surface(mesh.points, mesh.triangles),
               after = check_surface(fewer.points, fewer.triangles);
    ASSERT_TRUE(before && after) << sectors;
    EXPECT_EQ(after->euler_characteristic, before->euler_characteristic);
  }
}

TEST(SimplifiedSurface, FacetedSolidWithCylindersHasTheirVolume) {
  const auto psi = level_set(ring, 1, [](const Vec<3>&) { return -1.0; });
  const FacetedSolid solid = faceted_solid(material_surface(psi, 1, 2), 0.20, 0.34, 0.12);
  EXPECT_TRUE(solid.has_rim_cylinder && solid.has_tread_cylinder && solid.triangles.empty());
  EXPECT_EQ(solid.side_faces.size(), 2);
  EXPECT_NEAR(enclosed_volume(solid), pi * (0.34 * 0.34 - 0.2 * 0.2) * 0.12, 1e-12);
}

/// The volume of the cones of cone() in a wheel.
double cones_volume() {
  return ring.n_sectors * pi * 0.12 / 3 * (0.02 * 0.02 + 0.02 * 0.032 + 0.032 * 0.032);
}

TEST(LoftedSolid, OfConesHasTheirVolumeAndDeviatesLessThanTheTolerance) {
  const LevelSet<3> psi = cone(ring);
  const double tolerance = 5e-5;
  const auto solid = cad::lofted_solid(material_surface(psi, 2, 2), psi, tolerance);
  ASSERT_TRUE(solid) << solid.failure();
  EXPECT_EQ(solid->holes.size(), ring.n_sectors);
  EXPECT_EQ(solid->side_faces.size(), 2);
  const double whole = pi * (0.34 * 0.34 - 0.2 * 0.2) * 0.12;
  EXPECT_NEAR(enclosed_volume(*solid), whole - cones_volume(), 1e-4 * whole);
  for (const auto& hole : solid->holes)
    EXPECT_LE(cad::deviation(hole.surface, ZeroSurface(psi), 4).distance, tolerance);
}

/// The sides of a groove around the axle have 24 waves of 1 mm. At 16 points around the axle and in the
/// middles between them these look like 8 longer ones.
TEST(LoftedSolid, DoesNotMissWavesBetweenItsPoints) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 12, {14, 12, 8}};
  const auto psi = level_set(grid, 2, [](const Vec<3>& polar) {
    return 0.03 + 0.001 * std::cos(24 * polar[1]) - std::hypot(polar[0] - 0.27, polar[2] - 0.12);
  });
  const double tolerance = 1e-4;
  const auto solid = cad::lofted_solid(material_surface(psi, 2, 2), psi, tolerance);
  ASSERT_TRUE(solid) << solid.failure();
  ASSERT_EQ(solid->holes.size(), 1);
  EXPECT_GE(solid->holes[0].surface.columns, 2 * 24);
  EXPECT_LE(cad::deviation(solid->holes[0].surface, ZeroSurface(psi), 4).distance, tolerance);
}

TEST(LoftedSolid, SaysWhyItIsNone) {
  const auto ball = level_set(ring, 2, [&](const Vec<3>& polar) {
    const Vec<3> x = cartesian<3>(polar), centre = cartesian<3>({0.27, 0.37 * ring.sector_angle(), 0.05});
    return 0.03 - norm(x - centre);
  });
  const auto solid = cad::lofted_solid(material_surface(ball, 2, 2), ball, 1e-4);
  ASSERT_FALSE(solid);
  EXPECT_NE(solid.failure().find("closed cavities"), std::string::npos);
}

}  // namespace
}  // namespace wheelwright
