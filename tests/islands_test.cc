#include <gtest/gtest.h>

#include <algorithm>

#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {28, 24}};
const double sector = grid.sector_angle(), h = grid.resolution();

/// Holes, each with an island of the given radius in its middle; 0: none.
LevelSet<2> holes_with_islands(int degree, const std::vector<Circle>& holes, double island) {
  auto psi = make_level_set<2>(Lattice<2>(grid, degree), holes);
  if (island == 0) return psi;
  auto middles = holes;
  for (Circle& middle : middles) middle.hole_radius = island;
  const auto islands = make_level_set<2>(psi.lattice, middles);
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    psi.values[node] = std::min(psi.values[node], -islands.values[node]);
  return psi;
}

std::size_t n_pieces_of_material(const LevelSet<2>& psi) {
  const auto found = components(psi).all;
  return std::count_if(found.begin(), found.end(), [](const auto& c) { return c.is_material; });
}

/// Degree of the level set, azimuth of the hole in sectors, radius of the island in cells.
class Islands : public ::testing::TestWithParam<std::tuple<int, double, double>> {};

TEST_P(Islands, LeaveTheHoleThatTheyWereIn) {
  const auto [degree, azimuth, radius] = GetParam();
  const std::vector<Circle> hole{{0.27, azimuth * sector, 0.035}};
  const auto empty = holes_with_islands(degree, hole, 0);
  const auto psi = holes_with_islands(degree, hole, radius * h);
  ASSERT_EQ(n_pieces_of_material(psi), 2u);
  const auto attached = without_islands(psi, 1e-2);
  ASSERT_TRUE(attached);
  ASSERT_EQ(attached->removed.size(), 1u);
  EXPECT_EQ(attached->removed[0].kind, ShapeEventKind::island_removed);
  EXPECT_NEAR(attached->removed[0].place[0], 0.27, 0.2 * h);
  EXPECT_NEAR(std::remainder(attached->removed[0].place[1] - hole[0].centre_azimuth, sector) * 0.27, 0,
              0.2 * h);
  EXPECT_EQ(n_pieces_of_material(attached->psi), 1u);
  EXPECT_NEAR(material_measure(attached->psi), material_measure(empty), 1e-3 * material_measure(empty));
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    // Half way between the island and the hole's edge psi turns from the distance to one to that to the
    // other.
    const double past_half_way = 0.035 - empty.values[node] - 0.5 * (0.035 + radius * h);
    if (past_half_way > h) {
      EXPECT_EQ(attached->psi.values[node], psi.values[node]);
    } else if (past_half_way < -h) {
      EXPECT_NEAR(attached->psi.values[node], empty.values[node], 0.1 * h);
    } else {
      EXPECT_GT(attached->psi.values[node], psi.values[node] - 0.1 * h);
      EXPECT_LT(attached->psi.values[node], empty.values[node] + 0.1 * h);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, Islands,
                         ::testing::Combine(::testing::Values(1, 2), ::testing::Values(0.0, 0.37, 0.9),
                                            ::testing::Values(0.8, 2.0)));

TEST(Islands, OfAnAttachedShapeAreNone) {
  const auto psi = holes_with_islands(2, {{0.25, 0.0, 0.02}, {0.3, 0.2, 0.015}}, 0);
  const auto attached = without_islands(psi, 1e-2);
  ASSERT_TRUE(attached);
  EXPECT_TRUE(attached->removed.empty());
  EXPECT_EQ(attached->psi.values, psi.values);
}

TEST(Islands, AreAFailureWhenLarge) {
  const auto psi = holes_with_islands(2, {{0.27, 0.1, 0.035}}, 0.01);
  const double island = std::numbers::pi * 1e-4;
  EXPECT_TRUE(without_islands(psi, 1.1 * island));
  const auto kept = without_islands(psi, 0.9 * island);
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.failure().reason, FailureReason::disconnected_material);
}

// Seven holes that touch in a chain across the sector.
TEST(Islands, DoNotHoldTheTread) {
  std::vector<Circle> chain;
  for (int k = 0; k < 7; ++k) chain.push_back({0.27, k * sector / 7, 0.012});
  const auto psi = holes_with_islands(2, chain, 0);
  const auto attached = without_islands(psi, 1);
  ASSERT_FALSE(attached);
  EXPECT_EQ(attached.failure().reason, FailureReason::tread_cut_off);
}

TEST(Islands, InThreeDimensions) {
  const Lattice<3> lattice({0.20, 0.34, 0.12, 16, {14, 12, 6}}, 2);
  const std::vector<Circle> hole{{0.27, 0.1, 0.035}}, middle{{0.27, 0.1, 0.012}};
  auto psi = make_level_set<3>(lattice, hole);
  const auto island = make_level_set<3>(lattice, middle);
  const double empty = material_measure(psi);
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    psi.values[node] = std::min(psi.values[node], -island.values[node]);
  const auto attached = without_islands(psi, 1e-3);
  ASSERT_TRUE(attached);
  ASSERT_EQ(attached->removed.size(), 1u);
  EXPECT_NEAR(material_measure(attached->psi), empty, 1e-3 * empty);
}

// Holes of 0.3 cells in radius, in the middle of cells.
TEST(Changes, NameHolesLostOnTheGrid) {
  Case c;
  c.wheel.inner_radius = grid.inner_radius;
  c.wheel.outer_radius = grid.outer_radius;
  c.wheel.sectors = grid.n_sectors;
  c.grid.radial_cells = 28;
  c.grid.angular_cells = 384;
  c.grid.level_set_degree = 1;
  const double off_the_nodes = grid.radius(14.5);
  c.holes.rings = {{.count = 16, .center_radius = off_the_nodes, .radius = 0.03, .phase = {}}};
  EXPECT_TRUE(lost_on_the_grid<2>(c).empty());
  c.holes.rings = {
      {.count = 16, .center_radius = off_the_nodes, .radius = 0.3 * h, .phase = 12.5 / 24 * sector}};
  const auto tiny = lost_on_the_grid<2>(c);
  ASSERT_EQ(tiny.size(), 1u);
  EXPECT_EQ(tiny[0].kind, ShapeEventKind::hole_vanished);
  EXPECT_NEAR(tiny[0].place[0], off_the_nodes, 0.3 * h);
}

TEST(Changes, NameTheHoleThatReachesABand) {
  const Evolver<2> evolver(Lattice<2>(grid, 2), {{}, 0, {{0.01, 1}, {0.02, 1}}, {}});
  const auto shape = [&](double centre_radius, double radius) {
    return evolver.keep_bands(
        make_level_set<2>(Lattice<2>(grid, 2), std::vector<Circle>{{centre_radius, 0.3 * sector, radius}}));
  };
  const auto kinds = [&](const LevelSet<2>& before, const LevelSet<2>& after) {
    std::vector<ShapeEventKind> result;
    for (const auto& event : evolver.changes(before, after)) result.push_back(event.kind);
    return result;
  };
  using enum ShapeEventKind;
  const auto free = shape(0.26, 0.03), at_rim = shape(0.24, 0.03), at_tread = shape(0.29, 0.03),
             at_both = shape(0.265, 0.06);
  EXPECT_EQ(kinds(free, free), std::vector<ShapeEventKind>{});
  EXPECT_EQ(kinds(free, at_rim), std::vector{hole_at_rim_band});
  EXPECT_EQ(kinds(free, at_tread), std::vector{hole_at_tread_band});
  EXPECT_EQ(kinds(free, at_both), (std::vector{hole_at_rim_band, hole_at_tread_band}));
  EXPECT_EQ(kinds(at_rim, at_both), std::vector{hole_at_tread_band});
  EXPECT_EQ(kinds(at_both, at_both), std::vector<ShapeEventKind>{});
  const auto event = evolver.changes(free, at_tread)[0];
  EXPECT_NEAR(event.place[0], 0.32, h);
  EXPECT_NEAR(event.place[1], 0.3 * sector, 0.1);
}

}  // namespace
