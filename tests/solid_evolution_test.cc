#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/evolution/regrid.h"
#include "wheelwright/shape/geometry/shapes.h"

// How shapes that change along the axle evolve: holes that open and close at the side faces, merge and
// vanish, islands.

namespace wheelwright {
namespace {

const PolarGrid<3> grid{0.20, 0.34, 0.06, 12, {14, 12, 6}};
const Lattice<3> lattice(grid, 1);
const double h = grid.resolution(), middle = 0.5 * grid.sector_angle();

Evolver<3> evolver(double wall = 0) {
  return Evolver<3>(lattice, {{ExtensionKind::h1, 2}, 0.1, {{0.01, 1}, {0.02, 1}}, {.wall = wall, .gap = 0}});
}

LevelSet<3> full() { return make_level_set<3>(lattice, std::span<const Circle>{}); }

LevelSet<3> spheres(const std::vector<Sphere>& holes) {
  LevelSet<3> psi = full();
  for (const Sphere& hole : holes) psi = with_hole(std::move(psi), hole);
  return psi;
}

/// Every hole grown by a distance, in steps of half a cell; a negative distance shrinks them.
LevelSet<3> grown(LevelSet<3> psi, double distance) {
  const Evolver<3> moves = evolver();
  const std::vector<double> velocity(lattice.n_nodes(), distance > 0 ? -1.0 : 1.0);
  for (double left = std::abs(distance); left > 0; left -= 0.5 * h) {
    auto moved = moves.move(psi, velocity, std::min(left, 0.5 * h));
    if (!moved) throw std::runtime_error(moved.failure().detail);
    psi = *moves.redistance(*std::move(moved));
  }
  return psi;
}

double hole_volume(const LevelSet<3>& psi) { return material_measure(full()) - material_measure(psi); }

int count(const std::vector<ShapeEvent<3>>& events, ShapeEventKind kind) {
  return static_cast<int>(std::ranges::count(events, kind, &ShapeEvent<3>::kind));
}

/// Whether a hole opens a side face: the one at z = 0 or the one at z = width.
bool is_open(const LevelSet<3>& psi, bool at_width) {
  const int layer = at_width ? lattice.nodes()[2] - 1 : 0;
  for (int node = 0; node < lattice.n_nodes(); ++node)
    if (lattice.node_position(node)[2] == layer && psi.values[node] > 0) return true;
  return false;
}

bool is_symmetric(const LevelSet<3>& psi) {
  return mirror_symmetric_part(psi, MirrorPlane::width).values == psi.values &&
         mirror_symmetric_part(psi, MirrorPlane::azimuth).values == psi.values;
}

/// Volume of the part of a sphere within the width, if it reaches beyond both side faces.
double barrel(double radius, double half_width) {
  return std::numbers::pi * 2 * half_width * (radius * radius - half_width * half_width / 3);
}

const Sphere ball{0.262, middle, 0.03, 0.025};

TEST(SolidEvolution, ASphereThatGrowsOpensBothSideFacesAndClosesThemAgain) {
  const LevelSet<3> closed = spheres({ball});
  ASSERT_FALSE(is_open(closed, false));
  const LevelSet<3> open = grown(closed, 0.012);
  EXPECT_TRUE(is_open(open, false));
  EXPECT_TRUE(is_open(open, true));
  EXPECT_TRUE(is_symmetric(open));
  EXPECT_NEAR(hole_volume(open) / barrel(0.037, 0.03), 1, 0.06);
  // The opening's edge, a circle, moves as fast as the rest: it closes when its own radius is used up.
  const LevelSet<3> again = grown(open, -std::sqrt(0.037 * 0.037 - 0.03 * 0.03) - 0.5 * h);
  EXPECT_FALSE(is_open(again, false));
  EXPECT_FALSE(is_open(again, true));
  EXPECT_TRUE(is_symmetric(again));
  EXPECT_GT(hole_volume(again), 0);
}

TEST(SolidEvolution, ATaperedHoleClosesAtItsNarrowSide) {
  const auto cone = [&](double narrow) {
    return with_hole(full(), TaperedHole{0.262, middle, {{0, narrow}, {0.06, narrow + 0.03}}});
  };
  const LevelSet<3> through = cone(0.008);
  ASSERT_TRUE(is_open(through, false));
  const LevelSet<3> blind = grown(through, -0.014);
  EXPECT_FALSE(is_open(blind, false));
  EXPECT_TRUE(is_open(blind, true));
  EXPECT_TRUE(evolver().changes(through, blind).empty());
  // The boundary moves along its normal, so that the radius falls by more than the distance.
  const double slope = 0.5, narrower = 0.014 * std::sqrt(1 + slope * slope);
  EXPECT_NEAR(hole_volume(blind) / hole_volume(cone(0.008 - narrower)), 1, 0.1);
}

TEST(SolidEvolution, HolesMergeSplitAndVanishWithTheirEvents) {
  const LevelSet<3> two = spheres({{0.237, middle, 0.03, 0.019}, {0.285, middle, 0.03, 0.019}});
  const LevelSet<3> one = grown(two, 0.008);
  EXPECT_EQ(count(evolver().changes(two, one), ShapeEventKind::holes_merged), 1);
  const LevelSet<3> split = grown(one, -0.016);  // the neck's radius is sqrt(0.027^2 - 0.024^2)
  EXPECT_EQ(count(evolver().changes(one, split), ShapeEventKind::hole_split), 1);
  const LevelSet<3> none = grown(split, -0.02);
  EXPECT_EQ(count(evolver().changes(split, none), ShapeEventKind::hole_vanished), 2);
  EXPECT_NEAR(hole_volume(none), 0, 1e-12);
  EXPECT_TRUE(is_symmetric(none));
}

TEST(SolidEvolution, AnIslandIsRemovedAndTheShapeStaysSymmetric) {
  LevelSet<3> psi = spheres({ball});
  const LevelSet<3> empty = psi;
  Sphere core = ball;
  core.hole_radius = 0.011;
  const LevelSet<3> material = spheres({core});
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    psi.values[node] = std::min(psi.values[node], -material.values[node]);
  psi = mirror_symmetric_part(mirror_symmetric_part(psi), MirrorPlane::width);
  const auto attached = evolver().without_islands(psi, 1e-4);
  ASSERT_TRUE(attached) << attached.failure().detail;
  ASSERT_EQ(attached->removed.size(), 1u);
  EXPECT_EQ(attached->removed[0].kind, ShapeEventKind::island_removed);
  EXPECT_NEAR(attached->removed[0].place[2], 0.03, 0.2 * h);
  EXPECT_NEAR(hole_volume(attached->psi) / hole_volume(empty), 1, 0.02);
  EXPECT_TRUE(is_symmetric(attached->psi));
}

TEST(SolidEvolution, ThickenedWallsStaySymmetric) {
  const LevelSet<3> thin = spheres({{0.240, middle, 0.03, 0.02}, {0.290, middle, 0.03, 0.02}});
  const auto with_walls = evolver(0.02);
  const LevelSet<3> thick = with_walls.with_features(thin, with_walls.features());
  EXPECT_LT(hole_volume(thick), 0.99 * hole_volume(thin));
  EXPECT_TRUE(is_symmetric(thick));
}

TEST(SolidEvolution, AShapeOnAnotherGridStaysSymmetric) {
  const Lattice<3> finer({0.20, 0.34, 0.06, 12, {21, 16, 9}}, 1);
  EXPECT_TRUE(is_symmetric(regrid(spheres({ball}), finer)));
}

}  // namespace
}  // namespace wheelwright
