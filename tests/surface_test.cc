#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/shapes.h"
#include "wheelwright/shape/surface/check_surface.h"
#include "wheelwright/shape/surface/deviation.h"
#include "wheelwright/shape/surface/material_cells.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

/// 5 sectors; the numbers of cells have nothing in common.
const PolarGrid<3> ring{0.20, 0.34, 0.12, 5, {7, 11, 4}};

template <class Function>
LevelSet<3> level_set(const PolarGrid<3>& grid, int degree, const Function& psi) {
  LevelSet<3> result{Lattice<3>(grid, degree), {}};
  for (int node = 0; node < result.lattice.n_nodes(); ++node)
    result.values.push_back(psi(result.lattice.polar_point(node)));
  return result;
}

/// Inside a ball in every sector; without symmetry.
LevelSet<3> balls(const PolarGrid<3>& grid, int degree, const Vec<3>& centre, double radius) {
  return level_set(grid, degree, [&](const Vec<3>& polar) {
    double psi = -1;
    for (int image = -1; image <= 1; ++image) {
      const Vec<3> c = cartesian<3>({centre[0], centre[1] + image * grid.sector_angle(), centre[2]}),
                   x = cartesian<3>(polar);
      psi = std::max(psi, radius - std::hypot(x[0] - c[0], x[1] - c[1], x[2] - c[2]));
    }
    return psi;
  });
}

LevelSet<3> cylinders(const PolarGrid<3>& grid, int degree, double radius) {
  const Circle hole{0.27, 0.37 * grid.sector_angle(), radius};
  return make_level_set<3>(Lattice<3>(grid, degree), std::span(&hole, 1));
}

SurfaceReport checked(const SurfaceMesh& mesh) {
  const auto report = check_surface(mesh.points, mesh.triangles);
  EXPECT_TRUE(report) << report.failure().what;
  return report ? *report : SurfaceReport{};
}

/// (bodies, cavities, handles)
std::array<int, 3> topology(const SurfaceReport& report) {
  return {report.bodies, report.cavities, report.handles()};
}

TEST(Surface, RingWithoutHolesHasOneHandleAndTheExactAreaOfAPrism) {
  const auto solid = level_set(ring, 1, [](const Vec<3>&) { return -1.0; });
  for (const int parts : {1, 2, 3}) {
    const SurfaceMesh mesh = material_surface(solid, parts, 1);
    EXPECT_EQ(topology(checked(mesh)), (std::array{1, 0, 1}));
    // Isoparametric cells of degree 1 make a prism on a regular polygon.
    const double n = ring.ring_columns(), sine = std::sin(2 * pi / n);
    const double base = 0.5 * n * sine * (0.34 * 0.34 - 0.20 * 0.20), edge = 2 * n * std::sin(pi / n);
    EXPECT_NEAR(enclosed_volume(mesh), base * 0.12, 1e-14);
    EXPECT_NEAR(surface_area(mesh, SurfacePart::side), 2 * base, 1e-13);
    EXPECT_NEAR(surface_area(mesh, SurfacePart::tread), 0.34 * edge * 0.12, 1e-13);
    EXPECT_NEAR(surface_area(mesh, SurfacePart::rim), 0.20 * edge * 0.12, 1e-13);
    EXPECT_EQ(surface_area(mesh, SurfacePart::hole), 0);
  }
}

TEST(Surface, CylindersAreHandlesAndBallsAreCavities) {
  EXPECT_EQ(topology(checked(material_surface(cylinders(ring, 2, 0.03), 2, 2))), (std::array{1, 0, 1 + 5}));
  EXPECT_EQ(topology(checked(material_surface(balls(ring, 1, {0.27, 0.5, 0.06}, 0.035), 2, 1))),
            (std::array{1, 5, 1}));
  // A ball that breaks through one side face is a dent, one that breaks through both a handle.
  EXPECT_EQ(topology(checked(material_surface(balls(ring, 1, {0.27, 0.5, 0.11}, 0.035), 2, 1))),
            (std::array{1, 0, 1}));
  EXPECT_EQ(topology(checked(material_surface(balls(ring, 1, {0.27, 0.5, 0.06}, 0.066), 2, 1))),
            (std::array{1, 0, 1 + 5}));
  // A hole smaller than the distance of nodes vanishes.
  EXPECT_EQ(topology(checked(material_surface(balls(ring, 1, {0.271, 0.5, 0.055}, 0.001), 1, 1))),
            (std::array{1, 0, 1}));
}

TEST(Surface, AcrossTheSectorsAndTheSeam) {
  // The holes stand on the first azimuth of the sectors.
  const auto psi = balls(ring, 1, {0.27, 0.002, 0.06}, 0.04);
  const SurfaceMesh mesh = material_surface(psi, 2, 1);
  EXPECT_EQ(topology(checked(mesh)), (std::array{1, 5, 1}));
  // Every sector repeats the first.
  for (int s = 0; s < 5; ++s)
    for (int v = 0; v < mesh.sector_points(); ++v) {
      const Vec<3> x = rotated<3>(mesh.points[v], s * ring.sector_angle());
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(mesh.points[v + s * mesh.sector_points()][d], x[d], 1e-15);
    }
}

/// The exact measure of the polynomial on its cells is that of the cut quadrature, which shares no code with
/// the surface.
TEST(Surface, VolumeAndAreaConvergeToTheLevelSetsWithOrderTwo) {
  const PolarGrid<3> coarse{0.20, 0.34, 0.12, 8, {5, 7, 3}};
  for (const int degree : {1, 2}) {
    const auto psi = balls(coarse, degree, {0.27, 0.31, 0.07}, 0.047);
    const double volume = 8 * material_measure(psi);
    double area = 0;
    for (const auto& sample : boundary_samples(psi)) area += 8 * sample.weight;
    std::array<double, 2> volume_error, area_error;
    for (int k = 0; k < 2; ++k) {
      const SurfaceMesh mesh = material_surface(psi, 4 << k, degree);
      volume_error[k] = std::abs(enclosed_volume(mesh) / volume - 1);
      area_error[k] = std::abs(surface_area(mesh, SurfacePart::hole) / area - 1);
    }
    EXPECT_GT(std::log2(volume_error[0] / volume_error[1]), 1.8) << volume_error[0];
    EXPECT_GT(std::log2(area_error[0] / area_error[1]), 1.8) << area_error[0];
    EXPECT_LT(volume_error[1], 1e-3);
    EXPECT_LT(area_error[1], 1e-2);
  }
}

/// The radial distance is a polynomial of degree 2 on the grid: only the tetrahedra's linear psi is inexact.
TEST(Surface, VerticesLieOnTheLevelSetAndNormalsPointOutOfTheMaterial) {
  const auto psi = level_set(ring, 2, [](const Vec<3>& p) {
    return 0.04 * 0.04 - (p[0] - 0.27) * (p[0] - 0.27) - 0.01 * (p[1] - 0.5) * (p[1] - 0.5);
  });
  const SurfaceMesh coarse = material_surface(psi, 4, 2), mesh = material_surface(psi, 8, 2);
  EXPECT_EQ(topology(checked(mesh)), (std::array{1, 0, 1 + 5}));
  const SurfaceDeviation a = deviation(coarse, psi, 2), b = deviation(mesh, psi, 2);
  EXPECT_GT(std::log2(a.distance / b.distance), 1.6);
  EXPECT_LT(b.distance, 2e-4);
  for (std::size_t k = 0; k < mesh.triangles.size() / 5; ++k) {
    if (mesh.parts[k] != SurfacePart::hole) continue;
    const auto& t = mesh.triangles[k];
    Vec<3> u, v;
    for (int d = 0; d < 3; ++d) {
      u[d] = mesh.points[t[1]][d] - mesh.points[t[0]][d];
      v[d] = mesh.points[t[2]][d] - mesh.points[t[0]][d];
    }
    const Vec<3>& x = mesh.points[t[0]];
    const double radius = std::hypot(x[0], x[1]), azimuth = std::atan2(x[1], x[0]);
    // Out of the material, into the hole: along grad psi.
    const double radial = -2 * (radius - 0.27), along = -0.02 * (azimuth - 0.5) / radius;
    const Vec<3> gradient{radial * std::cos(azimuth) - along * std::sin(azimuth),
                          radial * std::sin(azimuth) + along * std::cos(azimuth), 0};
    EXPECT_GT(determinant<3>({u, v, gradient}), 0);
  }
}

/// The cells fill what the surface encloses.
TEST(MaterialCells, HaveTheSurfacesVolumeAndNoneIsInsideOut) {
  const auto psi = balls(ring, 2, {0.27, 0.1, 0.09}, 0.045);
  const MaterialCells cells = material_cells(psi, 2, 2);
  const auto corner = [&](std::size_t k) {
    const auto [vertex, in_next] = cells.corners[k];
    return in_next ? rotated<3>(cells.points[vertex], ring.sector_angle()) : cells.points[vertex];
  };
  const auto volume = [&](std::size_t begin, const std::array<int, 4>& t) {
    Mat<3> edges;
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) edges[i][d] = corner(begin + t[i + 1])[d] - corner(begin + t[0])[d];
    return determinant<3>(edges) / 6;
  };
  // VTK's corners: a prism of triangles (0, 1, 2) and (3, 4, 5), the first clockwise from the second.
  const std::vector<std::array<int, 4>> of_tetrahedron{{0, 1, 2, 3}},
      of_wedge{{0, 2, 1, 3}, {1, 3, 5, 4}, {1, 2, 5, 3}},
      of_hexahedron{{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  double sum = 0;
  std::size_t begin = 0;
  std::array<int, 3> count{};
  for (const MaterialCellKind kind : cells.kinds) {
    ++count[static_cast<int>(kind)];
    for (const auto& t : kind == MaterialCellKind::tetrahedron ? of_tetrahedron
                         : kind == MaterialCellKind::wedge     ? of_wedge
                                                               : of_hexahedron) {
      const double part = volume(begin, t);
      EXPECT_GT(part, 0) << static_cast<int>(kind);
      sum += part;
    }
    begin += n_corners(kind);
  }
  EXPECT_EQ(begin, cells.corners.size());
  for (const int n : count) EXPECT_GT(n, 100);
  EXPECT_NEAR(5 * sum / enclosed_volume(material_surface(psi, 2, 2)), 1, 1e-4);
}

/// The worst that can be: every node a small whole number, most of them 0.
TEST(Surface, IsAManifoldForRandomLevelSetsWithZerosOnNodes) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const PolarGrid<3> grid{0.1, 0.2, 0.05, 1 + trial % 4, {1 + trial % 3, 3 + trial % 5, 1 + trial % 2}};
    std::uniform_int_distribution<int> value(-2, 2);
    const auto psi = level_set(grid, 1 + trial % 2, [&](const Vec<3>&) { return 0.01 * value(random); });
    const SurfaceMesh mesh = material_surface(psi, 1 + trial % 3, 1);
    if (mesh.triangles.empty()) continue;
    EXPECT_GT(checked(mesh).volume, 0) << trial;
  }
}

TEST(Surface, OfAMirrorImageIsTheMirrorImage) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 5, {3, 6, 2}};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-0.02, 0.01);
  const auto psi = level_set(grid, 1, [&](const Vec<3>&) { return value(random); });
  LevelSet<3> image = psi;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    auto p = psi.lattice.node_position(node);
    p[1] = psi.lattice.nodes()[1] - p[1];
    p[2] = psi.lattice.nodes()[2] - 1 - p[2];
    image.values[psi.lattice.node_index(p)] = psi.values[node];
  }
  const SurfaceMesh a = material_surface(psi, 2, 1), b = material_surface(image, 2, 1);
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_NEAR(enclosed_volume(a), enclosed_volume(b), 1e-12 * enclosed_volume(a));
  for (const Vec<3>& x : a.points) {
    double nearest = 1;
    for (const Vec<3>& y : b.points)
      nearest = std::min(nearest, std::hypot(x[0] - y[0], x[1] + y[1], grid.width - x[2] - y[2]));
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(Surface, CheckFindsFaults) {
  const SurfaceMesh good = material_surface(cylinders(ring, 1, 0.03), 1, 1);
  const auto fails = [&](auto&& spoil) {
    SurfaceMesh mesh = good;
    spoil(mesh);
    return !check_surface(mesh.points, mesh.triangles);
  };
  EXPECT_FALSE(fails([](SurfaceMesh&) {}));
  EXPECT_TRUE(fails([](SurfaceMesh& m) { m.triangles.clear(); }));
  EXPECT_TRUE(fails([](SurfaceMesh& m) { m.triangles.pop_back(); }));
  EXPECT_TRUE(fails([](SurfaceMesh& m) { std::swap(m.triangles[7][0], m.triangles[7][1]); }));
  EXPECT_TRUE(fails([](SurfaceMesh& m) { m.triangles.push_back(m.triangles[3]); }));
  EXPECT_TRUE(fails([](SurfaceMesh& m) { m.points.push_back({1, 1, 1}); }));
  EXPECT_TRUE(fails([](SurfaceMesh& m) { m.points[m.triangles[3][0]] = m.points[m.triangles[3][1]]; }));
  // Two tetrahedra that touch at a vertex.
  const std::vector<Vec<3>> points{{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                   {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const std::vector<std::array<int, 3>> one{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  EXPECT_TRUE(check_surface(std::span(points).first(4), one));
  auto two = one;
  two.insert(two.end(), {{4, 6, 5}, {0, 5, 6}, {0, 6, 4}, {0, 4, 5}});
  EXPECT_FALSE(check_surface(points, two));
}

}  // namespace
}  // namespace wheelwright
