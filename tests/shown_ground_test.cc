#include "wheelwright/output/page/shown_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/mechanics/state/axle_height.h"

namespace wheelwright {
namespace {

constexpr double radius = 0.34;

/// A load position on that ground, without a solution.
template <int dim>
PositionFields<dim> standing_on(const Ground& ground, double camber = 0) {
  PolarGrid<dim> grid{0.2, radius, 0.1, 8, {}};
  grid.cells.fill(4);
  return {.lattice = Lattice<dim>(grid, 1),
          .displacement = {},
          .stress = {},
          .ground_azimuth = 0.3,
          .is_bonded = false,
          .ground = ground,
          .camber = camber,
          .rim = {},
          .travel = 0,
          .rim_force = {},
          .contact = {},
          .von_mises = {}};
}

/// The height of an outline, which ascends, between two of its places.
double height_at(const std::vector<Vec<2>>& outline, double along) {
  const auto next = std::ranges::lower_bound(outline, along, {}, [](const Vec<2>& p) { return p[0]; });
  const Vec<2>&a = *(next - 1), &b = *next;
  return std::lerp(a[1], b[1], (along - a[0]) / (b[0] - a[0]));
}

/// The shortest one of a line between two places.
double distance_from_axle(const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> along = b - a;
  const double length = dot(along, along);
  const double share = length > 0 ? std::clamp(-dot(a, along) / length, 0.0, 1.0) : 0;
  return norm<2>(a + share * along);
}

TEST(ShownGround, IsNothingWhereItIsFlatBelowAnUprightWheelAndEmptyWhereThereIsNone) {
  EXPECT_FALSE(shown_ground(standing_on<2>(Ground())));
  EXPECT_FALSE(shown_ground(standing_on<3>(Ground())));
  auto bonded = standing_on<2>(Ground());
  bonded.is_bonded = true;
  ASSERT_TRUE(shown_ground(bonded));
  EXPECT_TRUE(shown_ground(bonded)->outline.empty());
}

/// It is as exact near the contact as a magnified picture needs, and reaches beyond a wide one.
TEST(ShownGround, IsTheGroundOnWhichTheWheelStands) {
  const Ground drum = Ground::drum(0.5), internal = Ground::internal_drum(0.4),
               bar = Ground::bar(0.03, 0.02, 0.03), kerb = Ground::kerb(0.1, 0.05, 0.02),
               profile = Ground::profile({{-0.3, 0.01}, {-0.05, 0}, {0.04, 0.008}, {2, -0.1}});
  for (const Ground& ground : {drum, internal, bar, kerb, profile}) {
    const auto fields = standing_on<2>(ground);
    const double height = axle_height(fields.lattice.grid(), ground);
    const auto outline = shown_ground(fields)->outline;
    EXPECT_TRUE(std::ranges::is_sorted(outline, {}, [](const Vec<2>& p) { return p[0]; }));
    for (const auto& [along, up] : outline) EXPECT_NEAR(up, ground.height(along) - height, 1e-14);
    double clearance = 1;
    for (std::size_t k = 1; k < outline.size(); ++k)
      clearance = std::min(clearance, distance_from_axle(outline[k - 1], outline[k]) - radius);
    EXPECT_NEAR(clearance, 0, 3e-6 * radius);
    const double end = ground == drum ? 0.5 : ground == internal ? 0.4 : 4 * radius;
    EXPECT_NEAR(outline.front()[0], -end, 1e-12);
    EXPECT_NEAR(outline.back()[0], end, 1e-12);
    for (double along = -0.08; along < 0.08; along += 1e-4) {
      const bool is_side = ground == bar && std::abs(std::abs(along - 0.03) - 0.02) < 1e-3;
      if (is_side) continue;
      EXPECT_NEAR(height_at(outline, along), ground.height(along) - height, 1e-3 * radius) << along;
    }
    if (!ground.is_even()) continue;
    for (double along = -0.08; along < 0.08; along += 1e-4)
      EXPECT_NEAR(height_at(outline, along), ground.height(along) - height, 1e-6 * radius) << along;
  }
}

TEST(ShownGround, OfALeaningWheelTouchesItsEdge) {
  const auto shown = shown_ground(standing_on<3>(Ground(), -0.1));
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->camber, -0.1);
  for (const Vec<2>& place : shown->outline)
    EXPECT_NEAR(place[1], -(radius * std::cos(0.1) + 0.05 * std::sin(0.1)), 1e-15);
}

}  // namespace
}  // namespace wheelwright
