#include "wheelwright/shape/evolution/feature_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support.h"
#include "wheelwright/cad/drawing/chain.h"
#include "wheelwright/cad/drawing/composed_level_set.h"
#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/evolution/medial_balls.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/geometry/components.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

using testing::Hole;
using testing::holes;

PolarGrid<2> grid_of(int radial, int angular) { return {0.20, 0.34, 0.12, 16, {radial, angular / 16}}; }

/// Two holes whose edges are `wall` apart along the radius.
LevelSet<2> two_holes(const PolarGrid<2>& grid, double wall, double azimuth = 0.47) {
  const double r = 0.018, middle = 0.27, at = azimuth * grid.sector_angle();
  return holes(grid, 2, {{middle - r - wall / 2, at, r}, {middle + r + wall / 2, at, r}});
}

/// A hole across the face between sectors and one in the sector, `wall` apart along the azimuth.
LevelSet<2> holes_across_the_face(const PolarGrid<2>& grid, double wall) {
  const double r = 0.016, radius = 0.265, spacing = 2 * std::asin((2 * r + wall) / 2 / radius);
  return holes(grid, 2, {{radius, 0, r}, {radius, spacing, r}});
}

/// Two holes joined by a slit of this width between parallel edges.
LevelSet<2> holes_with_slit(const PolarGrid<2>& grid, double width) {
  LevelSet<2> psi =
      holes(grid, 2, {{0.235, 0.5 * grid.sector_angle(), 0.016}, {0.305, 0.5 * grid.sector_angle(), 0.016}});
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    const Vec<2> p = psi.lattice.polar_point(node);
    const double across = std::abs(p[0] * std::sin(p[1] - 0.5 * grid.sector_angle()));
    const double along = std::abs(p[0] * std::cos(p[1] - 0.5 * grid.sector_angle()) - 0.27) - 0.03;
    psi.values[node] = std::max(psi.values[node], -std::max(across - width / 2, along));
  }
  return psi;
}

/// A hole that is a regular hexagon with this inner radius, turned.
LevelSet<2> hexagonal_hole(const PolarGrid<2>& grid, const Vec<2>& polar_centre, double inner_radius) {
  const Lattice<2> lattice(grid, 2);
  const Vec<2> centre = cartesian<2>(polar_centre);
  LevelSet<2> psi{lattice, {}};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<2> x = cartesian<2>(lattice.polar_point(node));
    double outside = -inner_radius;
    for (int side = 0; side < 6; ++side) {
      const double angle = 0.2 + side * std::numbers::pi / 3;
      outside = std::max(outside, std::cos(angle) * (x[0] - centre[0]) +
                                      std::sin(angle) * (x[1] - centre[1]) - inner_radius);
    }
    psi.values.push_back(-outside);
  }
  return psi;
}

double wall_of(const LevelSet<2>& psi) { return outline_measures(psi)->clearances.wall->width; }

TEST(FeatureSize, ShapesThatHaveItAreUnchanged) {
  for (const auto& grid : {grid_of(14, 192), grid_of(28, 384)}) {
    const auto psi = two_holes(grid, 0.014);
    EXPECT_EQ(with_feature_size(psi, {.wall = 0.013, .gap = 0.02}).values, psi.values);
    const auto across = holes_across_the_face(grid, 0.014);
    EXPECT_EQ(with_feature_size(across, {.wall = 0.013, .gap = 0.02}).values, across.values);
  }
}

/// What the fitted curves of the outline show, which know nothing of how the shape was made.
TEST(FeatureSize, ThinWallsGetTheMinimumThickness) {
  for (const auto& grid : {grid_of(28, 384)})
    for (const double wall : {0.010, 0.013}) {
      for (const auto& psi : {two_holes(grid, 0.006), holes_across_the_face(grid, 0.006)}) {
        ASSERT_NEAR(wall_of(psi), 0.006, 2e-4);
        const auto thick = with_thick_walls(psi, wall);
        EXPECT_GT(wall_of(thick), 0.99 * wall);
        EXPECT_LT(wall_of(thick), 1.04 * wall);
        // Material is added, never taken; and only near the wall.
        for (size_t i = 0; i < psi.values.size(); ++i) EXPECT_LE(thick.values[i], psi.values[i]);
        EXPECT_LT(material_measure(thick) - material_measure(psi), 0.02 * wall);
        // Once is enough.
        const auto twice = with_thick_walls(thick, wall);
        EXPECT_NEAR(material_measure(twice), material_measure(thick), 1e-6);
      }
    }
}

/// The neck between small holes is thin over less than the distance of two nodes: wherever it lies between
/// them.
TEST(FeatureSize, NecksBetweenNodesGetTheMinimumThickness) {
  const auto grid = grid_of(28, 384);
  const double cell = grid.resolution(), wall = 1.05 * cell, r = 2 * cell;
  for (const double rows : {0.0, 0.125, 0.25, 0.375})
    for (const double columns : {0.0, 0.25}) {
      const double radius = 0.27 + rows * cell, spacing = 2 * std::asin((r + 0.175 * cell) / radius),
                   at = columns * grid.column_angle();
      const auto psi = holes(grid, 2, {{radius, at - spacing / 2, r}, {radius, at + spacing / 2, r}});
      ASSERT_FALSE(thin_walls(psi, 0.3 * wall).empty());
      EXPECT_TRUE(thin_walls(with_thick_walls(psi, wall), 0.5 * 0.97 * wall).empty())
          << rows << " rows and " << columns << " columns from a node";
    }
}

TEST(FeatureSize, TheMiddleOfAWallIsFound) {
  const auto grid = grid_of(28, 384);
  const double at = 0.47 * grid.sector_angle();
  const auto balls = thin_walls(two_holes(grid, 0.008), 0.005);
  ASSERT_FALSE(balls.empty());
  double thinnest = 1;
  for (const auto& ball : balls) thinnest = std::min(thinnest, ball.radius);
  EXPECT_NEAR(thinnest, 0.004, 5e-5);
  for (const auto& ball : balls) {
    EXPECT_LT(ball.radius, 0.005);
    // On the line that is as far from the one hole as from the other.
    const Vec<2> middle = cartesian<2>({0.27, at});
    EXPECT_LT(
        std::abs((ball.centre[0] - middle[0]) * std::cos(at) + (ball.centre[1] - middle[1]) * std::sin(at)),
        3e-4);
  }
  EXPECT_TRUE(thin_walls(two_holes(grid, 0.011), 0.005).empty());
  EXPECT_TRUE(
      thin_walls(LevelSet<2>{Lattice<2>(grid, 2), std::vector<double>(Lattice<2>(grid, 2).n_nodes(), -1.0)},
                 0.005)
          .empty());
}

/// Corners of a hexagonal hole become as round as asked; what is filled lies near them only, and a shape that
/// has the radius stays as it is.
TEST(FeatureSize, CornersAreRoundedToTheirRadius) {
  for (const auto& grid : {grid_of(14, 192), grid_of(28, 384)})
    for (const double radius : {0.010, 0.013}) {
      const double at = 0.47 * grid.sector_angle();
      const auto psi = redistance(hexagonal_hole(grid, {0.27, at}, 0.04));
      const FeatureSize size{.radius = radius};
      ASSERT_FALSE(narrowest_places(psi, size).empty());
      EXPECT_EQ(narrowest_places(psi, size)[0].kind, ShapeEventKind::sharp_corner_repaired);
      const auto rounded = with_feature_size(psi, size);
      EXPECT_TRUE(narrowest_places(rounded, size).empty());
      EXPECT_EQ(with_feature_size(rounded, size).values, rounded.values);
      for (size_t i = 0; i < psi.values.size(); ++i)
        if (psi.values[i] < -0.02 * grid.resolution()) {
          ASSERT_LT(rounded.values[i], 0);
        }
      // A corner of 120 degrees loses (tan 30 - pi / 6) radius^2.
      const double minimum = 6 * (std::tan(std::numbers::pi / 6) - std::numbers::pi / 6) * radius * radius;
      const double filled = material_measure(rounded) - material_measure(psi);
      EXPECT_GT(filled, 0.5 * minimum);
      EXPECT_LT(filled,
                (radius > 1.5 * grid.resolution() ? 4 : 6.5) * minimum);  // coarser cells, rounder corners
    }
}

TEST(FeatureSize, SlitsAndSmallHolesAreFilled) {
  const auto grid = grid_of(28, 384);
  const auto slit = holes_with_slit(grid, 0.006);
  const auto filled = without_narrow_gaps(slit, 0.012);
  const auto apart =
      holes(grid, 2, {{0.235, 0.5 * grid.sector_angle(), 0.016}, {0.305, 0.5 * grid.sector_angle(), 0.016}});
  EXPECT_LT(outline_measures(slit)->clearances.gap->width, 0.0065);
  EXPECT_GT(outline_measures(filled)->clearances.gap->width, 0.99 * 0.012);
  EXPECT_GT(material_measure(filled), material_measure(slit));
  EXPECT_LT(material_measure(filled), 1.002 * material_measure(apart));
  // A slit that is wide enough stays.
  const auto wide = holes_with_slit(grid, 0.014);
  EXPECT_EQ(without_narrow_gaps(wide, 0.012).values, wide.values);

  const auto small =
      holes(grid, 2, {{0.26, 0.5 * grid.sector_angle(), 0.03}, {0.315, 0.5 * grid.sector_angle(), 0.004}});
  const auto without = without_narrow_gaps(small, 0.012);
  EXPECT_NEAR(material_measure(without) - material_measure(small), M_PI * 0.004 * 0.004, 2e-6);
  const auto nothing = without_narrow_gaps(holes(grid, 2, {{0.27, 0.5 * grid.sector_angle(), 0.004}}), 0.012);
  EXPECT_TRUE(std::ranges::all_of(nothing.values, [](double x) { return x < 0; }));
}

/// Holes between the nodes, as small as the grid can hold any, beside one that is wide enough.
TEST(FeatureSize, HolesBetweenNodesAreNamedAndFilled) {
  const auto grid = grid_of(28, 384);
  const double cell = grid.resolution(), gap = 1.12 * cell, middle = 0.5 * grid.sector_angle();
  const Hole wide{0.25, middle, 3 * cell};
  const auto alone = holes(grid, 2, {wide});
  std::mt19937 random(3);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int n_small = 0;
  for (int k = 0; k < 100; ++k) {
    const Hole small{between(0.29, 0.31), middle + between(-0.08, 0.08), between(0.05, 0.5) * cell};
    const auto psi = holes(grid, 2, {wide, small});
    const bool is_there = components(psi).all.size() > components(alone).all.size();
    if (!is_there) continue;  // it lies between the samples of components() too
    ++n_small;
    EXPECT_FALSE(narrowest_places(psi, {.wall = 0, .gap = gap}).empty()) << k;
    const auto filled = without_narrow_gaps(psi, gap);
    EXPECT_EQ(components(filled).all.size(), components(alone).all.size()) << k;
    EXPECT_NEAR(material_measure(filled), material_measure(alone), 1e-2 * cell * cell) << k;
  }
  EXPECT_GT(n_small, 50);
}

/// Holes like drops, whose tips and waists a closing by the gap leaves partly open, wherever they lie between
/// the nodes.
TEST(FeatureSize, DropsAreFilledUntilNoGapIsNarrow) {
  const auto grid = grid_of(28, 384);
  const double cell = grid.resolution(), gap = 1.12 * cell, length = 6 * cell;
  for (int k = 0; k < 40; ++k) {
    const double radius = (0.35 + 0.02 * k) * cell,
                 at = 0.5 * grid.sector_angle() + 0.03 * k * grid.column_angle();
    LevelSet<2> psi = holes(grid, 2, {});
    for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
      const Vec<2> p = psi.lattice.polar_point(node);
      const double along = p[0] * std::cos(p[1] - at) - 0.262 - 0.01 * k * cell,
                   across = p[0] * std::sin(p[1] - at);
      // Circles whose radii fall from the head to the tip, and one at the end.
      const double part = std::clamp(along / length, 0.0, 1.0);
      const double drop = std::hypot(along - part * length, across) - radius * (1 - 0.9 * part);
      psi.values[node] = std::max(psi.values[node], -drop);
    }
    const auto filled = without_narrow_gaps(psi, gap);
    EXPECT_TRUE(narrowest_places(filled, {.gap = 0.96 * gap}).empty()) << k;
  }
}

/// The shift to a measure thins walls again; the shape that comes out has both.
TEST(FeatureSize, AShapeOfAGivenMeasureHasTheWidthsToo) {
  const auto grid = grid_of(28, 384);
  const double usual = 0.01;
  EvolutionOptions options;
  options.bands = {{usual, 1}, {usual, 2}};
  options.features = {.wall = 0.011, .gap = 0.012};
  const Evolver<2> evolver(Lattice<2>(grid, 2), options);
  for (const auto& psi :
       {two_holes(grid, 0.006), two_holes(grid, 0.006, 0.5), holes_across_the_face(grid, 0.005)}) {
    const double target = material_measure(psi);
    const auto shape = evolver.with_measure(psi, target, 0.2);
    ASSERT_TRUE(shape) << shape.failure().detail;
    EXPECT_NEAR(shape->measure, target, 1e-6 * target);
    EXPECT_GT(wall_of(shape->shape), 0.99 * 0.011);
    EXPECT_EQ(is_mirror_symmetric(shape->shape), is_mirror_symmetric(psi));
  }
}

/// A run that restarts from a shape that it accepted starts with that very shape; walls that are missed by
/// more than is accepted are made thick.
TEST(FeatureSize, AnAcceptedShapeIsAcceptedUnchanged) {
  const auto grid = grid_of(28, 384);
  const FeatureSize size{.wall = 0.011};
  const Evolver<2> evolver(Lattice<2>(grid, 2), {});
  for (const double azimuth : {0.31, 0.47, 0.5}) {
    const auto accepted = evolver.measured(two_holes(grid, 0.98 * size.wall, azimuth), size);
    ASSERT_TRUE(accepted) << accepted.failure().detail;
    const auto again = evolver.measured(accepted->shape, size);
    ASSERT_TRUE(again) << again.failure().detail;
    EXPECT_TRUE(again->shape.values == accepted->shape.values);
    const auto repaired = evolver.measured(two_holes(grid, 0.9 * size.wall, azimuth), size);
    ASSERT_TRUE(repaired) << repaired.failure().detail;
    EXPECT_GT(wall_of(repaired->shape), 0.99 * size.wall);
  }
}

/// The opening takes out the wall between two holes, which become one.
TEST(FeatureSize, ThinWallsAreRemoved) {
  const auto grid = grid_of(28, 384);
  const auto psi = two_holes(grid, 0.006);
  const auto without = without_thin_walls(psi, 0.010);
  EXPECT_EQ(components(psi).all.size(), 3u);
  EXPECT_EQ(components(without).all.size(), 2u);
  EXPECT_LT(material_measure(without), material_measure(psi));
  EXPECT_GT(material_measure(without), material_measure(psi) - 0.02 * 0.010);
  EXPECT_EQ(without_thin_walls(psi, 0.005).values, psi.values);
}

/// A window like a slice of a disc, whose corners have this angle [degrees] at the tip and 90 degrees.
LevelSet<2> slice(const PolarGrid<2>& grid, double angle, double direction, const Vec<2>& tip) {
  const double radius = 0.06, half = angle * M_PI / 360;
  const auto corner = [&](double turn) {
    return tip + radius * Vec<2>{std::cos(direction + turn), std::sin(direction + turn)};
  };
  const DrawnOutline window{{closed_loop(
      {Curve::line(tip, corner(-half)), Curve::circle_arc(tip, radius, direction - half, direction + half),
       Curve::line(corner(half), tip)},
      "")}};
  Figure figure{Fill::hole, {}};
  for (int sector = 0; sector < grid.n_sectors; ++sector)
    figure.outlines.push_back(window.mapped(Affine::rotation(sector * grid.sector_angle())));
  return make_level_set(Lattice<2>(grid, 2), Composition({figure}));
}

/// However they lie between the nodes.
TEST(FeatureSize, CornersAreNotNarrowPlaces) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const int rows : {14, 28, 42}) {
    const PolarGrid<2> grid{0.20, 0.34, 0.12, 8, {rows, 14 * rows / 8}};
    const double cell = grid.resolution();
    for (const double angle : {75.0, 90.0, 120.0})
      for (int k = 0; k < 6; ++k) {
        const double direction = between(0, 2 * M_PI);
        const Vec<2> middle = cartesian<2>({0.27 + between(-1, 1) * cell, 0.5 * grid.sector_angle()}),
                     tip = middle - 0.036 * Vec<2>{std::cos(direction), std::sin(direction)};
        const auto psi = slice(grid, angle, direction, tip);
        for (const double width : {1.12, 3.0}) {
          EXPECT_TRUE(narrowest_places(psi, {.wall = 0, .gap = width * cell}).empty())
              << rows << " rows, " << angle << " degrees, " << k;
          LevelSet<2> material = psi;
          for (double& value : material.values) value = -value;
          EXPECT_TRUE(narrowest_places(material, {.wall = width * cell, .gap = 0}).empty())
              << rows << " rows, " << angle << " degrees, " << k;
        }
      }
  }
}

TEST(FeatureSize, TheNarrowestPlacesAreNamed) {
  const auto grid = grid_of(28, 384);
  const auto places = narrowest_places(two_holes(grid, 0.006), {.wall = 0.010, .gap = 0.010});
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].kind, ShapeEventKind::thin_wall_repaired);
  EXPECT_NEAR(places[0].place[0], 0.27, 1e-3);
  EXPECT_NEAR(places[0].place[1], 0.47 * grid.sector_angle(), 1e-2);
  EXPECT_NEAR(places[0].measure, M_PI * 0.003 * 0.003, 2e-6);
  EXPECT_TRUE(narrowest_places(two_holes(grid, 0.006), {.wall = 0.005, .gap = 0.010}).empty());
  const auto slit = narrowest_places(holes_with_slit(grid, 0.006), {.wall = 0.001, .gap = 0.010});
  ASSERT_EQ(slit.size(), 1u);
  EXPECT_EQ(slit[0].kind, ShapeEventKind::narrow_gap_repaired);
}

TEST(FeatureSize, WallsOfA3DShapeBecomeThickToo) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 16, {14, 12, 3}};
  LevelSet<3> psi{Lattice<3>(grid, 1), {}};
  const double at = 0.5 * grid.sector_angle(), r = 0.018, wall = 0.010;
  const auto distance = [&](const Vec<3>& polar, double radius) {
    const Vec<2> x = cartesian<2>({polar[0], polar[1]}), c = cartesian<2>({radius, at});
    return r - std::hypot(x[0] - c[0], x[1] - c[1]);
  };
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    psi.values.push_back(std::max(distance(p, 0.27 - r - wall / 2), distance(p, 0.27 + r + wall / 2)));
  }
  const auto thick = with_thick_walls(psi, 0.020);
  EXPECT_GT(material_measure(thick), material_measure(psi));
  const auto balls = thin_walls(thick, 0.009);
  EXPECT_TRUE(balls.empty());
}

}  // namespace
}  // namespace wheelwright
