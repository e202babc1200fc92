// Wheels that pictures show cut open, and the side face that they show.

#include "wheelwright/output/report/cut_open.h"

#include <gtest/gtest.h>

#include <numbers>

#include "wheelwright/output/report/lit_wheel.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

PolarGrid<3> grid() { return {0.20, 0.34, 0.12, 8, {14, 3, 6}}; }

LevelSet<3> ring(const Lattice<3>& lattice) { return make_level_set<3>(lattice, std::span<const Circle>{}); }

/// A ring with a channel around the axle in the middle of its width: the columns are all alike.
SurfaceMesh with_channel() {
  const Lattice<3> lattice(grid(), 2);
  auto shape = ring(lattice);
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<3> p = lattice.polar_point(node);
    shape.values[node] = std::max(shape.values[node], 0.025 - std::hypot(p[0] - 0.27, p[2] - 0.06));
  }
  return material_surface(shape, 2, 2);
}

double enclosed(std::span<const Vec<3>> points, std::span<const std::array<int, 3>> triangles) {
  double volume = 0;
  for (const auto& [a, b, c] : triangles) volume += dot(points[a], cross(points[b], points[c])) / 6;
  return volume;
}

/// Kept triangles and cut faces enclose the part of the volume that the kept columns have: the faces are
/// whole, hold the channel's section, and look outwards.
TEST(CutOpen, EnclosesTheRestOfTheMaterial) {
  const SurfaceMesh whole = with_channel();
  const double volume = enclosed_volume(whole);
  for (const auto& [first, last] : {std::pair(4, 11), {0, 12}, {13, 24}, {23, 24}}) {
    const CutSurface cut = cut_open(whole, grid(), {first, last});
    const double rest = enclosed(whole.points, cut.triangles) + enclosed(cut.face_points, cut.face_triangles);
    EXPECT_NEAR(rest / volume, 1 - (last - first) / 24.0, 1e-9) << first << ' ' << last;
  }
}

TEST(CutOpen, OnlyClosedCavitiesNeedIt) {
  const Lattice<3> lattice(grid(), 2);
  EXPECT_TRUE(has_closed_cavities(with_channel()));
  EXPECT_FALSE(has_closed_cavities(material_surface(ring(lattice), 2, 2)));
  const auto groove = with_hole(ring(lattice), Groove{0.24, 0.30, 0.12, 0.05, 0.02});
  EXPECT_FALSE(has_closed_cavities(material_surface(groove, 2, 2)));
  const auto ball = with_hole(ring(lattice), Sphere{0.27, 0.3, 0.06, 0.03});
  EXPECT_TRUE(has_closed_cavities(material_surface(ball, 2, 2)));
}

/// Faces go through cavities, of balls between the columns of the plain choice, and areas are those of
/// sections.
TEST(CutOpen, FacesMeetCavities) {
  const PolarGrid<3> fine{0.20, 0.34, 0.12, 8, {14, 12, 6}};
  const Lattice<3> lattice(fine, 2);
  const double middle = 0.5 * fine.sector_angle();
  const SurfaceMesh balls =
      material_surface(with_hole(ring(lattice), Sphere{0.27, middle, 0.06, 0.03}), 2, 2);
  const double full = 0.14 * 0.12, hollow = full - std::numbers::pi * 0.03 * 0.03;
  const auto areas = section_areas(balls, fine);
  for (int sector = 0; sector < 8; ++sector) {
    EXPECT_NEAR(areas[12 * sector], full, 1e-4 * full);
    EXPECT_NEAR(areas[12 * sector + 6], hollow, 1e-2 * full);
  }
  for (const SideFace shown : {SideFace::larger_z, SideFace::smaller_z}) {
    const LitBody& faces = lit_wheel(balls, fine, shown)[1];
    double area = 0;
    for (const auto& [a, b, c] : faces.triangles)
      area += 0.5 * norm(cross(faces.points[b] - faces.points[a], faces.points[c] - faces.points[a]));
    EXPECT_NEAR(area, 2 * hollow, 2e-2 * full);
  }
}

/// The camera looks at the front of a side face, and at both cut faces.
TEST(LitWheel, ShowsTheSideFaceThatIsAskedFor) {
  const SurfaceMesh whole = with_channel();
  for (const SideFace shown : {SideFace::larger_z, SideFace::smaller_z}) {
    const Camera camera = wheel_camera(grid(), shown);
    const double outwards = shown == SideFace::larger_z ? 1 : -1;
    EXPECT_GT(camera.turned({0, 0, outwards})[2], 0.5);
    EXPECT_GT(camera.turned({0, 1, 0})[1], 0.9);
    const auto bodies = lit_wheel(whole, grid(), shown);
    ASSERT_EQ(bodies.size(), 2u);
    const LitBody& faces = bodies[1];
    for (const auto& [a, b, c] : faces.triangles) {
      const Vec<3> normal = cross(faces.points[b] - faces.points[a], faces.points[c] - faces.points[a]);
      if (norm(normal) > 1e-12) EXPECT_GT(camera.turned(normal)[2] / norm(normal), 0.3);
    }
  }
}

}  // namespace
}  // namespace wheelwright
