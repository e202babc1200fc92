#include "wheelwright/shape/geometry/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::holes;

const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {28, 24}};
const double sector = grid.sector_angle(), h = grid.resolution();

/// A level set of one sector, given by a function of (radius, azimuth).
template <int dim, class F>
LevelSet<dim> level_set(const PolarGrid<dim>& on, int degree, F f) {
  LevelSet<dim> psi{Lattice<dim>(on, degree), {}};
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    psi.values.push_back(f(psi.lattice.polar_point(node)));
  return psi;
}

/// Distance in the plane of (radius, azimuth) to a point and its images in the other sectors.
double distance(const Vec<2>& polar, double radius, double azimuth) {
  const double offset = std::remainder(polar[1] - azimuth, sector);
  return std::hypot(polar[0] * std::cos(offset) - radius, polar[0] * std::sin(offset));
}

template <int dim>
std::vector<Component<dim>> pieces(const Components<dim>& all, bool material) {
  std::vector<Component<dim>> result;
  for (const auto& component : all.all)
    if (component.is_material == material) result.push_back(component);
  return result;
}

double difference_of_azimuths(double a, double b) { return std::abs(std::remainder(a - b, sector)); }

class OneHole : public ::testing::TestWithParam<double> {};

TEST_P(OneHole, IsFoundAcrossTheSectorFace) {
  const double azimuth = GetParam() * sector, radius = 0.03, centre = 0.268;
  for (int degree : {1, 2}) {
    const auto found = components(holes(grid, degree, {{centre, azimuth, radius}}));
    const auto hole = pieces(found, false), material = pieces(found, true);
    ASSERT_EQ(hole.size(), 1u);
    ASSERT_EQ(material.size(), 1u);
    EXPECT_TRUE(material[0].at_rim && material[0].at_tread);
    EXPECT_FALSE(hole[0].at_rim || hole[0].at_tread);
    EXPECT_LT(difference_of_azimuths(hole[0].centre[1], azimuth) * centre, 0.05 * h);
    EXPECT_GE(hole[0].centre[1], 0);
    EXPECT_LT(hole[0].centre[1], sector);
    // The centre of mass of a disk in polar coordinates lies radius^2 / (4 centre) farther out.
    EXPECT_NEAR(hole[0].centre[0], centre + radius * radius / (4 * centre), 0.1 * h);
    EXPECT_NEAR(hole[0].measure, pi * radius * radius, 0.1 * h * 2 * pi * radius);
    EXPECT_NEAR(hole[0].innermost[0], centre - radius, 0.5 * h);
    EXPECT_NEAR(hole[0].outermost[0], centre + radius, 0.5 * h);
    EXPECT_NEAR(hole[0].measure + material[0].measure, 0.5 * sector * (0.34 * 0.34 - 0.2 * 0.2), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Azimuths, OneHole, ::testing::Values(0.0, 0.03, 0.31, 0.5, 0.98));

TEST(Components, AnIslandMayCrossTheSectorsFace) {
  for (double azimuth : {0.0, 0.4 * sector}) {
    const auto psi = level_set<2>(grid, 2, [&](const Vec<2>& p) {
      const double d = distance(p, 0.27, azimuth);
      return std::min(0.03 - d, d - 0.012);
    });
    const auto material = pieces(components(psi), true);
    ASSERT_EQ(material.size(), 2u);
    const auto& island = material[material[0].at_rim ? 1 : 0];
    EXPECT_FALSE(island.at_rim || island.at_tread);
    EXPECT_LT(difference_of_azimuths(island.centre[1], azimuth) * 0.27, 0.05 * h);
    EXPECT_NEAR(island.measure, pi * 0.012 * 0.012, 0.1 * h * 2 * pi * 0.012);
  }
}

/// A slit of half-width w around the whole ring, bridged where |azimuth - skew (r - 0.27)| is small.
LevelSet<2> bridged_slit(double skew) {
  return level_set<2>(grid, 2, [&](const Vec<2>& p) {
    const double slit = 0.05 - std::abs(p[0] - 0.27);
    const double spoke = std::abs(std::remainder(p[1] - skew * (p[0] - 0.27), sector)) * p[0] - 0.008;
    return std::min(slit, spoke);
  });
}

TEST(Components, ASpokeMayReachTheTreadInANeighbouringSector) {
  for (double skew : {0.0, 0.5 * sector / 0.05, 1.7 * sector / 0.05}) {
    const auto material = pieces(components(bridged_slit(skew)), true);
    ASSERT_EQ(material.size(), 1u) << skew;
    EXPECT_TRUE(material[0].at_rim && material[0].at_tread);
  }
}

TEST(Components, ASlitCutsTheTreadOff) {
  const auto psi = level_set<2>(grid, 2, [](const Vec<2>& p) { return 0.02 - std::abs(p[0] - 0.27); });
  const auto material = pieces(components(psi), true);
  ASSERT_EQ(material.size(), 2u);
  EXPECT_NE(material[0].at_rim, material[1].at_rim);
  EXPECT_NE(material[0].at_tread, material[0].at_rim);
  EXPECT_NE(material[1].at_tread, material[1].at_rim);
}

// A ligament that runs diagonally through the samples, thinner than a cell, holds; cut, it does not.
TEST(Components, FollowADiagonalLigament) {
  const double slope = grid.column_angle() / grid.row_height(0);
  for (double gap : {-1.0, 0.003}) {
    const auto psi = level_set<2>(grid, 1, [&](const Vec<2>& p) {
      const double slit = 0.05 - std::abs(p[0] - 0.27);
      const double across = std::remainder(p[1] - slope * (p[0] - 0.27), sector) * p[0];
      const double ligament = std::abs(across) - 0.6 * h;
      return std::min(slit, std::max(ligament, gap - std::abs(p[0] - 0.27)));
    });
    EXPECT_EQ(pieces(components(psi), true).size(), gap < 0 ? 1u : 2u);
  }
}

/// A saddle in the middle of four samples, with material in opposite corners.
struct Saddle {
  double azimuth;  ///< [cells]; 23.875 and 0.125 are next to the sector's face, at its two sides
  int diagonal;    ///< 1 or -1: along which the material lies
};

void PrintTo(const Saddle& saddle, std::ostream* out) {
  *out << "azimuth " << saddle.azimuth << ", diagonal " << saddle.diagonal;
}

class OneSaddle : public ::testing::TestWithParam<Saddle> {};

// psi at the saddle says which corners are joined there, and half a sector away the other two are: one piece
// of material and one hole. psi of the saddle's cell, not that of a neighbour beyond its own cell, where it
// has the other sign.
TEST_P(OneSaddle, IsResolvedByTheValueOfPsi) {
  for (int sign : {-1, 1}) {
    const auto psi = level_set<2>(grid, 1, [&](const Vec<2>& p) {
      const double outward = (p[0] - grid.inner_radius) / grid.row_height(0) - 14.125;
      const double along = std::remainder(p[1] / grid.column_angle() - GetParam().azimuth, grid.cells[1]);
      const double at_saddle = 1e-3 + 0.02 * std::max(0.0, std::abs(along) - 0.125);
      const double half_a_sector_away = 0.5 * std::max(0.0, std::abs(along) - 10);
      return sign * (at_saddle - half_a_sector_away) - GetParam().diagonal * outward * along;
    });
    const auto found = components(psi);
    EXPECT_EQ(pieces(found, true).size(), 1u) << sign;
    EXPECT_EQ(pieces(found, false).size(), 1u) << sign;
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, OneSaddle,
                         ::testing::Values(Saddle{12.125, 1}, Saddle{12.125, -1}, Saddle{23.875, 1},
                                           Saddle{23.875, -1}, Saddle{0.125, 1}, Saddle{0.125, -1}));

// As many holes as the boundary has curves, on shapes with holes that overlap, nearly touch and cross faces.
TEST(Components, CountTheBoundarysCurves) {
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int counted = 0;
  for (int degree : {1, 2})
    for (int shape = 0; shape < 40; ++shape) {
      std::vector<testing::Hole> drawn;
      for (int k = 0; k < 6; ++k)
        drawn.push_back({uniform(0.24, 0.3), uniform(0, sector), uniform(0.5 * h, 0.018)});
      const auto psi = holes(grid, degree, drawn);
      const auto found = components(psi);
      const auto all_material = pieces(found, true);
      if (std::any_of(found.all.begin(), found.all.end(),
                      [](const auto& c) { return !c.is_material && c.measure > 0.02 * 0.02 * 8; }))
        continue;  // chained round the ring perhaps: its curves are not one a sector
      const auto curves = material_contours(psi, component_samples);
      EXPECT_EQ(16 * (pieces(found, false).size() + all_material.size() - 1), curves.size() - 2) << shape;
      ++counted;
    }
  EXPECT_GE(counted, 60);
}

TEST(Components, InThreeDimensions) {
  const PolarGrid<3> solid{0.20, 0.34, 0.12, 8, {14, 12, 8}};
  const auto cavity = [&](const Vec<3>& p, double axial) {
    const double offset = std::remainder(p[1] - 0.1, solid.sector_angle());
    return std::hypot(p[0] * std::cos(offset) - 0.27, p[0] * std::sin(offset), p[2] - axial);
  };
  const auto psi = level_set<3>(solid, 2, [&](const Vec<3>& p) {
    return std::max(0.025 - cavity(p, 0.03), std::min(0.03 - cavity(p, 0.09), cavity(p, 0.09) - 0.012));
  });
  const auto found = components(psi);
  EXPECT_EQ(pieces(found, false).size(), 2u);
  EXPECT_EQ(pieces(found, true).size(), 2u);
  double whole = 0;
  for (const auto& c : found.all) whole += c.measure;
  EXPECT_NEAR(whole, 0.12 * pi / 8 * (0.34 * 0.34 - 0.2 * 0.2), 1e-12);
}

// --- changes ---

std::vector<ShapeEvent<2>> changes(const std::vector<testing::Hole>& before,
                                   const std::vector<testing::Hole>& after) {
  return topology_changes(components(holes(grid, 2, before)), components(holes(grid, 2, after)));
}

TEST(TopologyChanges, AreNoneWhereHolesMove) {
  EXPECT_TRUE(
      changes({{0.25, 0.1, 0.02}, {0.3, 0.3, 0.02}}, {{0.253, 0.11, 0.018}, {0.3, 0.3, 0.022}}).empty());
}

// The two holes of a sector lie 0.12 rad apart; the second may lie in the next sector.
TEST(TopologyChanges, NameMergingAndSplittingWithThePlace) {
  for (double first : {0.1, 0.45 * sector, sector - 0.03}) {
    const auto pair = [&](double radius) {
      return std::vector<testing::Hole>{{0.27, first, radius}, {0.27, first + 0.12, radius}};
    };
    const auto merged = changes(pair(0.013), pair(0.018));
    ASSERT_EQ(merged.size(), 1u) << first;
    EXPECT_EQ(merged[0].kind, ShapeEventKind::holes_merged);
    EXPECT_LT(difference_of_azimuths(merged[0].place[1], first + 0.06) * 0.27, 0.1 * h);
    EXPECT_NEAR(merged[0].place[0], 0.27, 0.2 * h);
    const auto split = changes(pair(0.018), pair(0.013));
    ASSERT_EQ(split.size(), 1u);
    EXPECT_EQ(split[0].kind, ShapeEventKind::hole_split);
    EXPECT_EQ(split[0].place, merged[0].place);
    EXPECT_EQ(split[0].measure, merged[0].measure);
  }
}

TEST(TopologyChanges, NameNewAndVanishingHoles) {
  const auto gone = changes({{0.25, 0.1, 0.02}, {0.3, 0.3, 0.01}}, {{0.25, 0.1, 0.02}});
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0].kind, ShapeEventKind::hole_vanished);
  EXPECT_NEAR(gone[0].place[0], 0.3, 0.2 * h);
  EXPECT_NEAR(gone[0].place[1], 0.3, 0.2 * h);
  EXPECT_NEAR(gone[0].measure, pi * 1e-4, 0.1 * pi * 1e-4);
  const auto come = changes({{0.25, 0.1, 0.02}}, {{0.25, 0.1, 0.02}, {0.3, 0.3, 0.01}});
  ASSERT_EQ(come.size(), 1u);
  EXPECT_EQ(come[0].kind, ShapeEventKind::hole_appeared);
  EXPECT_EQ(come[0].place, gone[0].place);
}

}  // namespace
}  // namespace wheelwright
