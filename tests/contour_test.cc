#include "wheelwright/shape/geometry/contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

constexpr double hole_radius = 0.04, mid_radius = 0.27;

PolarGrid<2> wheel_grid(int radial, int columns) { return {0.20, 0.34, 0.12, 16, {radial, columns}}; }

/// Signed distance of one circular hole a sector, centred at (mid_radius, azimuth).
LevelSet<2> hole_level_set(const PolarGrid<2>& grid, int degree, double azimuth, double centre_radius) {
  const Lattice<2> lattice(grid, degree);
  LevelSet<2> psi{lattice, {}};
  for (int k = 0; k < lattice.n_nodes(); ++k) {
    const Vec<2> x = cartesian<2>(lattice.polar_point(k));
    double nearest = 1;
    for (int s = -1; s <= 1; ++s) {
      const Vec<2> centre = cartesian<2>({centre_radius, azimuth + s * grid.sector_angle()});
      nearest = std::min(nearest, std::hypot(x[0] - centre[0], x[1] - centre[1]));
    }
    psi.values.push_back(hole_radius - nearest);
  }
  return psi;
}

std::vector<Contour> of_kind(const std::vector<Contour>& contours, ContourKind kind) {
  std::vector<Contour> result;
  for (const Contour& c : contours)
    if (c.kind == kind) result.push_back(c);
  return result;
}

double total_area(const std::vector<Contour>& contours) {
  double sum = 0;
  for (const Contour& c : contours) sum += signed_area(c);
  return sum;
}

double longest_edge(const Contour& contour) {
  double longest = 0;
  for (std::size_t k = 0; k < contour.points.size(); ++k) {
    const Vec<2>&a = contour.points[k], &b = contour.points[(k + 1) % contour.points.size()];
    longest = std::max(longest, std::hypot(b[0] - a[0], b[1] - a[1]));
  }
  return longest;
}

double cross(const Vec<2>& o, const Vec<2>& a, const Vec<2>& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

bool edges_cross(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d) {
  return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

int self_intersections(const Contour& contour) {
  const auto& p = contour.points;
  const int n = p.size();
  int count = 0;
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j) count += edges_cross(p[i], p[i + 1], p[j], p[(j + 1) % n]);
  return count;
}

double polygon_area(const MaterialPolygon& polygon, const CellMap<2>& map, int degree) {
  Contour mapped{ContourKind::free, {}};
  for (const Vec<2>& xi : polygon) mapped.points.push_back(map.position(ShapeFunctions<2>(degree, xi)));
  return signed_area(mapped);
}

TEST(Contour, AreaAndPerimeterOfSixteenHoles) {
  for (const double azimuth : {pi / 16, 0.0, 0.013}) {
    const auto psi = hole_level_set(wheel_grid(28, 24), 2, azimuth, mid_radius);
    const auto holes = of_kind(material_contours(psi, contour_subdivisions(2)), ContourKind::free);
    ASSERT_EQ(holes.size(), 16u);
    for (const Contour& hole : holes) {
      EXPECT_NEAR(-signed_area(hole) / (pi * hole_radius * hole_radius), 1, 5e-5);
      EXPECT_NEAR(perimeter(hole) / (2 * pi * hole_radius), 1, 2e-5);
      EXPECT_LT(longest_edge(hole), 2e-3);
      EXPECT_EQ(self_intersections(hole), 0);
    }
  }
}

TEST(Contour, EveryVertexIsOnTheCircle) {
  for (int degree : {1, 2}) {
    const auto psi = hole_level_set(wheel_grid(28, 24), degree, 0.0, mid_radius);
    const auto holes = of_kind(material_contours(psi, contour_subdivisions(degree)), ContourKind::free);
    const double tolerance = degree == 1 ? 1e-4 : 2e-6;
    for (const Contour& hole : holes) {
      Vec<2> lower = hole.points.front(), upper = lower;
      for (const Vec<2>& p : hole.points)
        for (int d = 0; d < 2; ++d) {
          lower[d] = std::min(lower[d], p[d]);
          upper[d] = std::max(upper[d], p[d]);
        }
      const Vec<2> centre = 0.5 * (lower + upper);
      EXPECT_NEAR(std::hypot(centre[0], centre[1]), mid_radius, 2e-4);
      const double turn = std::round(std::atan2(centre[1], centre[0]) / (pi / 8)) * (pi / 8);
      const Vec<2> exact = cartesian<2>({mid_radius, turn});
      for (const Vec<2>& p : hole.points)
        EXPECT_NEAR(std::hypot(p[0] - exact[0], p[1] - exact[1]), hole_radius, tolerance);
    }
  }
}

TEST(Contour, AreaErrorIsSecondOrderInTheSubdivisions) {
  const auto psi = hole_level_set(wheel_grid(28, 24), 2, 0.05, mid_radius);
  const double exact = 16 * pi * hole_radius * hole_radius;
  double previous = 0;
  for (int n : {1, 2, 4, 8}) {
    const double error = exact + total_area(of_kind(material_contours(psi, n), ContourKind::free));
    if (n > 1) {
      EXPECT_GT(std::log2(previous / error), 1.8);
    }
    previous = error;
  }
}

TEST(Contour, SignedAreasAddUpToTheMaterial) {
  const auto psi = hole_level_set(wheel_grid(28, 24), 2, 0.0, mid_radius);
  const auto contours = material_contours(psi, 4);
  EXPECT_EQ(of_kind(contours, ContourKind::rim).size(), 1u);
  EXPECT_EQ(of_kind(contours, ContourKind::tread).size(), 1u);
  const double exact = pi * (0.34 * 0.34 - 0.2 * 0.2) - 16 * pi * hole_radius * hole_radius;
  EXPECT_NEAR(total_area(contours) / exact, 1, 1e-4);
}

TEST(Contour, HoleAcrossTheSectorFaceIsTheTurnedHole) {
  const PolarGrid<2> grid = wheel_grid(28, 24);
  const auto across = hole_level_set(grid, 2, 0.0, mid_radius);
  const auto inside = hole_level_set(grid, 2, 0.5 * grid.sector_angle(), mid_radius);
  const auto a = of_kind(material_contours(across, 4), ContourKind::free);
  const auto b = of_kind(material_contours(inside, 4), ContourKind::free);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.front().points.size(), b.front().points.size());
  EXPECT_NEAR(signed_area(a.front()), signed_area(b.front()), 1e-15);
  EXPECT_NEAR(perimeter(a.front()), perimeter(b.front()), 1e-14);
}

TEST(Contour, HoleThroughTheTreadStillGivesClosedCurves) {
  const auto psi = hole_level_set(wheel_grid(28, 24), 2, 0.1, 0.33);
  const auto contours = material_contours(psi, 4);
  EXPECT_EQ(of_kind(contours, ContourKind::tread).size(), 0u);
  EXPECT_EQ(of_kind(contours, ContourKind::rim).size(), 1u);
  const auto free = of_kind(contours, ContourKind::free);
  ASSERT_EQ(free.size(), 1u);
  const Contour& star = free.front();
  EXPECT_GT(signed_area(star), 0);
  EXPECT_LT(longest_edge(star), 2e-3);
}

TEST(Contour, SolidRingHasNoFreeContour) {
  LevelSet<2> psi{Lattice<2>(wheel_grid(4, 6), 2), {}};
  psi.values.assign(psi.lattice.n_nodes(), -0.01);
  const auto contours = material_contours(psi, 4);
  EXPECT_EQ(contours.size(), 2u);
  EXPECT_NEAR(total_area(contours), pi * (0.34 * 0.34 - 0.2 * 0.2), 1e-4);
}

TEST(Contour, EmptyRingHasNone) {
  LevelSet<2> psi{Lattice<2>(wheel_grid(4, 6), 2), {}};
  psi.values.assign(psi.lattice.n_nodes(), 0.01);
  EXPECT_TRUE(material_contours(psi, 4).empty());
}

TEST(Contour, OneSectorIsTheFullRing) {
  const PolarGrid<2> sixteen = wheel_grid(14, 12);
  PolarGrid<2> one = sixteen;
  one.n_sectors = 1;
  one.cells[1] = 12 * 16;
  const auto psi = hole_level_set(sixteen, 2, 0.0, mid_radius);
  LevelSet<2> ring{Lattice<2>(one, 2), {}};
  for (int s = 0; s < 16; ++s) ring.values.insert(ring.values.end(), psi.values.begin(), psi.values.end());
  const auto a = material_contours(psi, 4), b = material_contours(ring, 4);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_NEAR(total_area(a), total_area(b), 1e-14);
}

/// Random nodal values with exact zeros: every sample pattern, every ambiguous case, tangent vertices.
TEST(Contour, RandomLevelSetsGiveClosedDisjointCurvesWithTheArea) {
  unsigned state = 1;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) / 4294967296.0; };
  for (int trial = 0; trial < 100; ++trial) {
    const int degree = 1 + trial % 2;
    const PolarGrid<2> grid{0.2, 0.34, 0.12, 8 + trial % 3, {3, 8}};
    LevelSet<2> psi{Lattice<2>(grid, degree), {}};
    for (int k = 0; k < psi.lattice.n_nodes(); ++k)
      psi.values.push_back(random() < 0.2 ? 0.0 : 0.01 * (random() - 0.5));
    const auto contours = material_contours(psi, 3);
    for (const Contour& c : contours) EXPECT_EQ(self_intersections(c), 0);

    const auto polygons = material_polygons(psi, 3);
    double area = 0;
    for (int cell = 0; cell < grid.n_cells(); ++cell) {
      const CellMap<2> map(grid, degree, grid.cell_position(cell));
      for (const MaterialPolygon& p : polygons[cell]) area += grid.n_sectors * polygon_area(p, map, degree);
    }
    EXPECT_NEAR(total_area(contours), area, 1e-3 * area);
  }
}

}  // namespace
}  // namespace wheelwright
