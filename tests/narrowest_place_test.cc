#include "wheelwright/shape/evolution/narrowest_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/shape/evolution/feature_size.h"
#include "wheelwright/shape/evolution/widths.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

const PolarGrid<3> grid{0.20, 0.34, 0.12, 16, {28, 24, 20}};

LevelSet<3> ring() { return make_level_set<3>(Lattice<3>(grid, 2), {}); }

std::optional<NarrowestPlace<3>> narrowest(const LevelSet<3>& psi, Side side) {
  return narrowest_place(MedialBalls<3>(psi), side);
}

double sector() { return grid.sector_angle(); }

TEST(NarrowestPlace, OfASolidRingIsNone) {
  EXPECT_FALSE(narrowest(ring(), Side::material));
  EXPECT_FALSE(narrowest(ring(), Side::holes));
  EXPECT_EQ(closed_cavities(ring()), 0);
}

/// Between two balls, and the diameter of the smaller one.
TEST(NarrowestPlace, IsBetweenTwoBallsAndInTheSmallerOne) {
  auto psi = with_hole(ring(), Sphere{0.255, 0.5 * sector(), 0.055, 0.018});
  psi = with_hole(std::move(psi), Sphere{0.289, 0.5 * sector(), 0.055, 0.010});
  const auto wall = narrowest(psi, Side::material), gap = narrowest(psi, Side::holes);
  ASSERT_TRUE(wall && gap);
  EXPECT_NEAR(wall->width, 0.289 - 0.255 - 0.018 - 0.010, 3e-4);
  EXPECT_NEAR(std::hypot(wall->middle[0], wall->middle[1]), 0.276, 1e-3);
  EXPECT_NEAR(wall->middle[2], 0.055, 1e-3);
  EXPECT_NEAR(gap->width, 0.020, 4e-4);
  EXPECT_EQ(closed_cavities(psi), 2);
}

/// To each surface of the ring.
TEST(NarrowestPlace, IsToTheNearestSurfaceOfTheRing) {
  struct Placed {
    double radius, height;
    double wall;
  };
  for (const auto& [radius, height, wall] : {Placed{0.27, 0.026, 0.006}, Placed{0.27, 0.093, 0.007},
                                             Placed{0.228, 0.06, 0.008}, Placed{0.311, 0.06, 0.009}}) {
    const auto found =
        narrowest(with_hole(ring(), Sphere{radius, 0.3 * sector(), height, 0.020}), Side::material);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->width, wall, 3e-4) << radius << " " << height;
  }
}

/// A slot with parallel sides and a tip of 40 degrees, whose sides are closer but no neck.
TEST(NarrowestPlace, IsNotInATip) {
  LevelSet<3> slot = ring();
  const double half_width = 0.012, sine = std::sin(20 * std::numbers::pi / 180),
               cosine = std::sqrt(1 - sine * sine);
  for (int node = 0; node < slot.lattice.n_nodes(); ++node) {
    const Vec<3> place = slot.lattice.polar_point(node);
    const double turned = place[1] - 0.5 * sector(), along = place[0] * std::cos(turned) - 0.27,
                 across = std::abs(place[0] * std::sin(turned));
    slot.values[node] =
        std::min({half_width - across, along + 0.03, (0.045 - along) * sine - across * cosine});
  }
  const auto gap = narrowest(slot, Side::holes);
  ASSERT_TRUE(gap);
  EXPECT_NEAR(gap->width, 2 * half_width, 5e-4);
}

/// A groove opens at the side face: it is no cavity, and its sides there are no thin walls.
TEST(NarrowestPlace, OfGroovesIsTheDiscBetweenThem) {
  auto psi = with_hole(ring(), Groove{0.22, 0.31, 0, 0.05, 0.01});
  psi = with_hole(std::move(psi), Groove{0.22, 0.31, 0.12, 0.057, 0.01});
  const auto wall = narrowest(psi, Side::material);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->width, 0.12 - 0.05 - 0.057, 2e-4);
  EXPECT_EQ(closed_cavities(psi), 0);
}

/// A ball over a side face: its wall is a width with the derivative of its thickness, and is thickened.
TEST(WallsToFaces, AreWidthsAndAreThickened) {
  const auto psi = with_hole(ring(), Sphere{0.27, 0.4 * sector(), 0.026, 0.020});
  const auto widths = narrow_widths(psi, {.wall = 0.008}, 0);
  ASSERT_FALSE(widths.empty());  // the most critical one first
  EXPECT_NEAR(widths[0].value, 0.006, 1e-4);
  EXPECT_NEAR(widths[0].place[2], 0.003, 1e-4);
  double by_all = 0;  // a level set that falls everywhere by the same moves the boundary outwards by that
  for (const auto& [node, weight] : widths[0].slopes) by_all += weight;
  EXPECT_NEAR(std::abs(by_all), 1, 0.01);
  const double step = 1e-5;
  auto moved = psi;
  for (double& value : moved.values) value -= step;
  const auto after = narrow_widths(moved, {.wall = 0.008}, 0);
  ASSERT_FALSE(after.empty());
  EXPECT_NEAR((after[0].value - widths[0].value) / step, -by_all, 0.02);
  const auto thick = narrowest(with_thick_walls(psi, 0.008), Side::material);
  ASSERT_TRUE(thick);
  EXPECT_NEAR(thick->width, 0.008, 4e-4);
}

}  // namespace
}  // namespace wheelwright
