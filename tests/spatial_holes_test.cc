#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/mechanics/elasticity/sector_stiffness.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/section.h"
#include "wheelwright/shape/geometry/shapes.h"

// Holes that change along the axle.

namespace wheelwright {
namespace {

constexpr double pi = std::numbers::pi;

PolarGrid<3> grid_of(int cells) { return {0.20, 0.34, 0.12, 12, {cells, cells, cells}}; }

const LevelSet<3> full(const PolarGrid<3>& grid) {
  return make_level_set<3>(Lattice<3>(grid, 1), std::span<const Circle>{});
}

/// Volume of the hole and area of its boundary in one sector.
struct Measures {
  double volume, area;
};
Measures measures(const LevelSet<3>& psi) {
  const auto domain = cut_domain(psi, 4);
  EXPECT_TRUE(domain);
  const PolarGrid<3>& grid = psi.lattice.grid();
  const double sector = 0.5 * grid.sector_angle() *
                        (grid.outer_radius * grid.outer_radius - grid.inner_radius * grid.inner_radius) *
                        grid.width;
  // The measure of all cells, not of the ring that they approximate.
  const double of_cells = material_measure(full(grid));
  EXPECT_NEAR(of_cells / sector, 1, 0.05);
  Measures found{of_cells - material_measure(*domain, psi.lattice.degree()), 0};
  for (const auto& cut : domain->cut) {
    const CellMap<3> map(grid, psi.lattice.degree(), grid.cell_position(cut.cell));
    for (const auto& q : cut.boundary)
      found.area +=
          q.weight *
          map_surface<3>(map.jacobian(ShapeFunctions<3>(psi.lattice.degree(), q.xi)), q.normal).scale;
  }
  return found;
}

template <class Hole>
void expect_second_order(const Hole& hole, const Measures& exact) {
  double volume_error[2], area_error[2];
  for (const int k : {0, 1}) {
    const Measures found = measures(with_hole(full(grid_of(k == 0 ? 10 : 20)), hole));
    volume_error[k] = std::abs(found.volume / exact.volume - 1);
    area_error[k] = std::abs(found.area / exact.area - 1);
  }
  EXPECT_GT(std::log2(volume_error[0] / volume_error[1]), 1.8);
  EXPECT_GT(std::log2(area_error[0] / area_error[1]), 1.8);
  EXPECT_LT(volume_error[1], 0.015);
  EXPECT_LT(area_error[1], 0.01);
}

TEST(SpatialHoles, ASphereHasItsVolumeAndAreaToSecondOrder) {
  const double r = 0.0431;
  expect_second_order(Sphere{0.2713, 0.4 * 2 * pi / 12, 0.0617, r}, {4 * pi / 3 * r * r * r, 4 * pi * r * r});
}

// A blind hole: a cone with its tip in the wheel and its base in the side face.
TEST(SpatialHoles, AConeHasItsVolumeAndArea) {
  const double r = 0.04, height = 0.08;
  const TaperedHole cone{0.27, 0.5 * 2 * pi / 12, {{0, r}, {height, 0}, {0.1, -0.01}}};
  const Measures found = measures(with_hole(full(grid_of(20)), cone));
  EXPECT_NEAR(found.volume / (pi * r * r * height / 3), 1, 0.02);
  EXPECT_NEAR(found.area / (pi * r * std::hypot(r, height)), 1, 0.02);
}

// Where the radius does not change, a tapered hole is the circle of 2D.
TEST(SpatialHoles, AConstantProfileIsACylinder) {
  const auto grid = grid_of(6);
  const Circle circle{0.26, 0.2, 0.03};
  const auto expected = make_level_set<3>(Lattice<3>(grid, 2), std::span(&circle, 1));
  const auto psi = with_hole(make_level_set<3>(Lattice<3>(grid, 2), std::span<const Circle>{}),
                             TaperedHole{0.26, 0.2, {{0, 0.03}, {0.06, 0.03}, {0.12, 0.03}}});
  for (size_t i = 0; i < psi.values.size(); ++i)
    EXPECT_NEAR(psi.values[i], std::max(expected.values[i], -0.14), 1e-14);
}

// The nearest point of the boundary may lie at another height.
TEST(SpatialHoles, DistancesAreToTheNearestPointOfTheBoundary) {
  const auto grid = grid_of(6);
  const TaperedHole cone{0.27, 0, {{0, 0.01}, {0.06, 0.04}, {0.12, 0.01}}};
  const double slope = std::atan2(0.03, 0.06);
  for (const double height : {0.02, 0.04}) {
    const double radius = 0.01 + 0.5 * height;
    EXPECT_NEAR(signed_distance(grid, cone, {0.27 + radius - 0.003, 0, height}), 0.003 * std::cos(slope),
                1e-12);
    EXPECT_NEAR(signed_distance(grid, cone, {0.27 + radius + 0.002, 0, height}), -0.002 * std::cos(slope),
                1e-12);
  }
  EXPECT_NEAR(signed_distance(grid, cone, {0.27 + 0.05, 0, 0.06}), -0.01, 1e-12);  // beyond the edge
  EXPECT_NEAR(signed_distance(grid, cone, {0.28, 0.01, 0.03}),
              signed_distance(grid, cone, {0.28, 0.01 + grid.sector_angle(), 0.03}), 1e-15);
}

// Cut cells of the two halves are each other's image up to the last bit.
TEST(SpatialHoles, TheCutOfASymmetricShapeIsSymmetric) {
  const auto grid = grid_of(6);
  auto psi = with_hole(full(grid), TaperedHole{0.2673, 0.21, {{0, 0.041}, {0.06, 0.029}, {0.12, 0.041}}});
  psi = mirror_symmetric_part(psi, MirrorPlane::width);
  ASSERT_TRUE(is_mirror_symmetric(psi, MirrorPlane::width));
  const auto domain = cut_domain(psi, 4);
  ASSERT_TRUE(domain);
  ASSERT_FALSE(domain->cut.empty());
  std::vector<const CutCell<3>*> cut(grid.n_cells(), nullptr);
  for (const auto& cell : domain->cut) cut[cell.cell] = &cell;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const int image = mirror_image(grid, cell, MirrorPlane::width);
    ASSERT_EQ(domain->kinds[cell], domain->kinds[image]);
    if (cut[cell] == nullptr) continue;
    ASSERT_EQ(cut[cell]->material.size(), cut[image]->material.size());
    for (size_t q = 0; q < cut[cell]->material.size(); ++q) {
      EXPECT_EQ(cut[cell]->material[q].weight, cut[image]->material[q].weight);
      EXPECT_NEAR(cut[cell]->material[q].xi[2], 1 - cut[image]->material[q].xi[2], 1e-15);
    }
  }
}

// A patch test: the stiffness of a linear displacement is the load of its traction on the cut boundary, at
// all nodes away from the outer faces. Ghost penalty does nothing to it.
TEST(SpatialHoles, ALinearDisplacementIsInEquilibriumWithItsTraction) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 12, {8, 8, 4}};
  auto psi = with_hole(full(grid), Sphere{0.2713, 0.47 * grid.sector_angle(), 0.0617, 0.0331});
  const Material material{200e6, 0.4};
  const Mat<3> slope{{{0.3, -0.2, 0.5}, {0.1, 0.4, -0.3}, {-0.6, 0.2, 0.1}}};
  Voigt<3> strain{slope[0][0],
                  slope[1][1],
                  slope[2][2],
                  slope[1][2] + slope[2][1],
                  slope[0][2] + slope[2][0],
                  slope[0][1] + slope[1][0]};
  const Voigt<3> sigma = stress<3>(material, strain);
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    const ElementTable<3> table(grid, degree, material, {GhostPenaltyKind::full, 1e-2});
    const auto domain = cut_domain(psi, 8);
    ASSERT_TRUE(domain);
    const auto sector = sector_stiffness(*domain, table, grid.cells[0]);
    const SectorSpace<3>& space = sector.space;
    const Lattice<3> lattice(grid, degree);
    std::vector<double> u(space.n_dofs()), force(space.n_dofs(), 0.0);
    for (int node = 0; node < space.n_nodes(); ++node) {
      const Vec<3> polar = lattice.polar_point(space.position(node)), x = cartesian<3>(polar);
      Vec<3> value{};
      for (int i = 0; i < 3; ++i) value[i] = dot<3>(slope[i], x);
      value = rotated<3>(value, -polar[1]);
      for (int c = 0; c < 3; ++c) u[space.dof(node, c)] = value[c];
    }
    sector.matrix.add_product(u.data(), force.data());
    double largest = 0;
    for (const auto& cut : domain->cut) {
      const auto nodes = space.cell_nodes(cut.cell);
      const double azimuth = grid.cell_position(cut.cell)[1] * grid.column_angle();
      for (const auto& q : cut.boundary) {
        const auto at = table.element(grid.cell_position(cut.cell)[0]).at(q.xi);
        const auto surface = map_surface<3>(at.jacobian, q.normal);
        const Vec<3> t = rotated<3>(traction<3>(sigma, rotated<3>(surface.normal, azimuth)), -azimuth);
        for (size_t a = 0; a < nodes.size(); ++a)
          for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d) {
              const double load = q.weight * surface.scale * at.displacement[d][3 * a + c] * t[d];
              force[space.dof(nodes[a], c)] -= load;
              largest = std::max(largest, std::abs(force[space.dof(nodes[a], c)]));
            }
      }
    }
    int tested = 0;
    for (int node = 0; node < space.n_nodes(); ++node) {
      const auto& p = space.position(node);
      bool is_inner = p[1] >= 2 * degree && p[1] <= lattice.nodes()[1] - 2 * degree;
      for (const int d : {0, 2})
        is_inner = is_inner && p[d] > (d == 0 ? 2 * degree : 0) && p[d] < lattice.nodes()[d] - 1;
      if (!is_inner) continue;
      ++tested;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(force[space.dof(node, c)], 0, 1e-6 * largest);
    }
    EXPECT_GT(tested, 50);
  }
}

// A level set that is linear along the axle has in the middle the mean of its values at the side faces.
TEST(Section, IsThatOfTheMiddleOfTheWidthOnAnyGrid) {
  for (const int axial_cells : {1, 2, 3, 4, 5})
    for (const int degree : {1, 2}) {
      const PolarGrid<3> grid{0.20, 0.34, 0.12, 12, {4, 5, axial_cells}};
      LevelSet<3> psi{Lattice<3>(grid, degree), {}};
      for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
        const auto p = psi.lattice.polar_point(node);
        psi.values.push_back(3 * p[0] - 2 + std::cos(12 * p[1]) + (1 + 5 * p[0]) * p[2]);
      }
      const auto section = mid_plane_section(psi);
      for (int node = 0; node < section.lattice.n_nodes(); ++node) {
        const auto p = section.lattice.polar_point(node);
        EXPECT_NEAR(section.values[node], 3 * p[0] - 2 + std::cos(12 * p[1]) + (1 + 5 * p[0]) * 0.06, 1e-14);
      }
    }
}

}  // namespace
}  // namespace wheelwright
