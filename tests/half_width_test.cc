#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/quantities/functionals/peak_pressure.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

/// What both solvers say is compared to rounding, which contact and thin parts of cells magnify, and a nearly
/// incompressible material by lambda over mu.
double rounding_of(const RollingModel<3>& model) {
  return model.materials.at_tread().isotropic()->nearly_incompressible() ? 3e-8 : 1e-10;
}

RollingModel<3> wheel(int degree, int axial_cells) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, axial_cells}};
  model.degree = degree;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  model.tread.annulus_points = 2;
  return model;
}

/// A hole that is narrower in the middle of the width, in a place without symmetry in azimuth.
LevelSet<3> waisted_hole(const PolarGrid<3>& grid, double turn = 0.47) {
  const Circle hole{0.2581, turn * grid.sector_angle(), 0.0253};
  auto psi = make_level_set<3>(Lattice<3>(grid, 1), std::span(&hole, 1));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    psi.values[i] += 0.003 * std::cos(50 * (psi.lattice.polar_point(i)[2] - 0.5 * grid.width));
  return mirror_symmetric_part(psi, MirrorPlane::width);
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, size = 0;
  for (size_t i = 0; i < b.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    difference = std::max(difference, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  if (a.size() != b.size()) return INFINITY;
  return size > 0 ? difference / size : difference;
}

std::vector<double> numbers(const Matrix& a) { return {a.entries().begin(), a.entries().end()}; }

std::vector<double> numbers(const ContactPatch<3>& patch) {
  std::vector<double> all{patch.rim.towards_ground, patch.rim.along_ground, patch.rim.rotation};
  for (const auto& point : patch.points) all.insert(all.end(), point.position.begin(), point.position.end());
  return all;
}

void expect_the_same_patch(const ContactPatch<3>& a, const ContactPatch<3>& b, double rounding = 1e-10) {
  EXPECT_LT(difference(numbers(a), numbers(b)), rounding);
  EXPECT_NEAR(a.rim_force.towards_ground, b.rim_force.towards_ground, 1e-7);
  EXPECT_NEAR(a.rim_force.torque, b.rim_force.torque, 1e-7);
  EXPECT_NEAR(a.rim_force.along_axle, b.rim_force.along_axle, 1e-7);
  ASSERT_EQ(a.stiffness.has_value(), b.stiffness.has_value());
  if (a.stiffness) EXPECT_NEAR(*a.stiffness / *b.stiffness, 1, 1e-8);
  ASSERT_EQ(a.points.size(), b.points.size());
  std::vector<double> tractions_a, tractions_b;
  for (size_t k = 0; k < a.points.size(); ++k) {
    EXPECT_EQ(a.points[k].column, b.points[k].column);
    EXPECT_EQ(a.points[k].point, b.points[k].point);
    EXPECT_NEAR(a.points[k].weight, b.points[k].weight, 1e-18);
    EXPECT_NEAR(a.points[k].gap, b.points[k].gap, 1e-15);
    for (int d = 0; d < 3; ++d) {
      tractions_a.push_back(a.points[k].traction[d]);
      tractions_b.push_back(b.points[k].traction[d]);
    }
  }
  EXPECT_LT(difference(tractions_a, tractions_b), 100 * rounding);
}

void expect_the_same_surface(const TreadSurface<3>& a, const TreadSurface<3>& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t q = 0; q < a.points.size(); ++q) {
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(a.points[q].position[d], b.points[q].position[d], 1e-15);
    EXPECT_NEAR(a.points[q].weight, b.points[q].weight, 1e-18);
    EXPECT_NEAR(a.points[q].gamma / b.points[q].gamma, 1, 1e-14);
  }
  EXPECT_LT(difference(a.annulus_weights, b.annulus_weights), 1e-13);
  EXPECT_EQ(a.mirror_images, b.mirror_images);
  ASSERT_EQ(a.face_rows.size(), b.face_rows.size());
  for (size_t k = 0; k < a.face_rows.size(); ++k) {
    EXPECT_EQ(a.face_rows[k].faces, b.face_rows[k].faces);
    EXPECT_EQ(a.face_rows[k].first, b.face_rows[k].first);
    EXPECT_EQ(a.face_rows[k].per_face, b.face_rows[k].per_face);
    EXPECT_EQ(a.face_rows[k].per_point, b.face_rows[k].per_point);
    EXPECT_EQ(a.face_rows[k].points_per_face, b.face_rows[k].points_per_face);
  }
  EXPECT_EQ(a.n_columns, b.n_columns);
  EXPECT_EQ(a.has_spin, b.has_spin);
}

/// Integrals of a density over the moving boundary, against functions without any symmetry.
std::vector<double> moments(const PolarGrid<3>& grid, const std::vector<SurfaceSample<3>>& density) {
  std::vector<double> result(4, 0.0);
  for (const auto& point : density) {
    const auto cell = grid.cell_position(point.cell);
    const double z = cell[2] + point.xi[2], r = cell[0] + point.xi[0];
    const double weighted = point.weight * point.value;
    result[0] += weighted;
    result[1] += weighted * z;
    result[2] += weighted * z * z * point.normal[2];
    result[3] += weighted * r * std::sin(z + 0.3 * (cell[1] + point.xi[1]));
  }
  return result;
}

void expect_the_same_states(const RollingModel<3>& model, const State<3>& a, const State<3>& b) {
  const double rounding = rounding_of(model);
  EXPECT_LT(difference(a.strain_energy(), b.strain_energy()), rounding);
  EXPECT_LT(difference(numbers(a.observations()), numbers(b.observations())), rounding);
  ASSERT_EQ(a.contacts().size(), b.contacts().size());
  for (size_t i = 0; i < a.contacts().size(); ++i) {
    expect_the_same_patch(a.contacts()[i], b.contacts()[i], rounding);
    EXPECT_LT(difference(a.displacement().at_nodes(static_cast<int>(i)).values,
                         b.displacement().at_nodes(static_cast<int>(i)).values),
              rounding);
  }
  const std::vector<Vec<3>> points{{0.2, 0.7, 0.3}, {0.9, 0.1, 0.6}};
  for (int cell = 0; cell < model.grid.n_cells(); ++cell)
    if (a.domain().kinds[cell] == CellKind::inside) {
      EXPECT_LT(difference(numbers(a.displacement().strains(cell, points).by_rows()),
                           numbers(b.displacement().strains(cell, points).by_rows())),
                100 * rounding);  // of the strains of this cell, which may be small
      EXPECT_LT(difference(numbers(a.displacement().strains_and_rotations(cell, points).by_rows()),
                           numbers(b.displacement().strains_and_rotations(cell, points).by_rows())),
                100 * rounding);
    }
  EXPECT_LT(difference(a.strain_peaks().von_mises, b.strain_peaks().von_mises), rounding);
  EXPECT_LT(difference(a.strain_peaks().principal, b.strain_peaks().principal), rounding);
}

void expect_the_same(const RollingModel<3>& model, const LevelSet<3>& psi, const WeightedSum<3>& terms) {
  const auto whole = RollingProblem<3>::create(model);
  const auto half = HalfWidthSolver::create(model);
  ASSERT_TRUE(whole) << whole.failure().detail;
  ASSERT_TRUE(half) << half.failure().detail;
  expect_the_same_surface((*half)->tread_surface(), whole->tread_surface());
  const auto positions = whole->distinct_positions(psi);
  const auto a = (*half)->states(psi, positions, {}), b = whole->states(psi, positions, {});
  ASSERT_TRUE(a) << a.failure().detail;
  ASSERT_TRUE(b) << b.failure().detail;
  expect_the_same_states(model, **a, **b);
  for (const auto& term : terms) {
    SCOPED_TRACE(term.functional->name());
    const WeightedSum<3> one{term};
    const auto of_a = testing::evaluate_objective<3>(**half, one, psi),
               of_b = testing::evaluate_objective<3>(*whole, one, psi);
    ASSERT_TRUE(of_a) << of_a.failure().detail;
    ASSERT_TRUE(of_b) << of_b.failure().detail;
    EXPECT_NEAR(of_a->function("objective").value / of_b->function("objective").value, 1, rounding_of(model));
    EXPECT_LT(difference(moments(model.grid, of_a->gradient("objective")),
                         moments(model.grid, of_b->gradient("objective"))),
              1e-7);
    EXPECT_LT(difference(moments(model.grid, of_a->edge_gradient("objective")),
                         moments(model.grid, of_b->edge_gradient("objective"))),
              1e-7);
  }
}

WeightedSum<3> all_functionals(const RollingModel<3>& model) {
  auto map = RollingProblem<3>::create(model)->neumann_to_dirichlet(DualNorm::elasticity);
  return {{1, std::make_shared<StrainEnergy<3>>()},
          {1, std::make_shared<UniformityAnnulus<3>>(0.02)},
          {1, std::make_shared<UniformityL2<3>>(0.02)},
          {1, std::make_shared<UniformityDual<3>>(*std::move(map))}};
}

TEST(HalfWidth, AgreesWithTheWholeWidth) {
  const auto model = wheel(1, 4);
  expect_the_same(model, waisted_hole(model.grid), all_functionals(model));
}

TEST(HalfWidth, WithAFinerTreadFrictionAndAllLoadsInTheWheelsPlane) {
  auto model = wheel(2, 2);
  model.tread.levels = 1;
  model.contact.friction = 0.5;
  model.torque = 120;
  model.horizontal_force = 80;
  model.distributed = {{4e4, 2e4, 0}, 2e4, 30};
  model.materials = Material{200e6, 0.3, Plane::strain, 1100};
  model.n_positions = 1;
  expect_the_same(model, waisted_hole(model.grid), {{1, std::make_shared<StrainEnergy<3>>()}});
}

// The penalty of pressure jumps acts across the middle plane too.
TEST(HalfWidth, NearlyIncompressibleBetweenSymmetricSideFaces) {
  auto model = wheel(2, 4);
  model.grid.cells = {8, 6, 4};
  model.side_faces = SideFaces::symmetric;
  model.materials = Material{200e6, 0.4999};
  model.n_positions = 1;
  model.tread.annulus_points = 0;
  expect_the_same(model, waisted_hole(model.grid), {{1, std::make_shared<StrainEnergy<3>>()}});
}

TEST(HalfWidth, OfShapesThatAreMirrorSymmetricInAzimuthToo) {
  auto model = wheel(1, 2);
  model.distributed.hole_pressure = 2e4;
  const auto psi = waisted_hole(model.grid, 0.5);
  ASSERT_TRUE(is_mirror_symmetric(psi));
  expect_the_same(model, psi, {{1, std::make_shared<StrainEnergy<3>>()}});
}

// Other shapes and loads are solved on the whole width.
TEST(HalfWidth, IsNotUsedWithoutSymmetry) {
  auto model = wheel(1, 2);
  model.contact.friction = 0.5;  // it holds the wheel that is pushed along the axle
  const auto whole = RollingProblem<3>::create(model);
  const auto half = HalfWidthSolver::create(model);
  auto psi = waisted_hole(model.grid);
  auto pushed = model;
  pushed.lateral_force = 300;
  const auto a = testing::all_states<3>(**half, psi), b = testing::all_states<3>(*whole, psi);
  ASSERT_TRUE(a && b);
  const auto a_pushed = (*a)->under(pushed, {}), b_pushed = (*b)->under(pushed, {});
  ASSERT_TRUE(a_pushed && b_pushed);
  expect_the_same_states(model, **a_pushed, **b_pushed);
  auto heavier = model;
  heavier.load *= 1.5;
  const std::vector models{heavier, pushed};
  const auto a_both = (*a)->contacts_under(models, {}), b_both = (*b)->contacts_under(models, {});
  const auto a_heavier = (*a)->contacts_under(std::span(models).first(1), {}).front();
  ASSERT_TRUE(a_heavier);
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(a_both[k] && b_both[k]);
    expect_the_same_patch((*a_both[k])[0], (*b_both[k])[0]);
  }
  expect_the_same_patch((*a_heavier)[0], (*b_both[0])[0]);

  psi.values.back() += 1e-4;
  const auto uneven_a = testing::all_states<3>(**half, psi), uneven_b = testing::all_states<3>(*whole, psi);
  ASSERT_TRUE(uneven_a && uneven_b);
  EXPECT_LT(difference((*uneven_a)->strain_energy(), (*uneven_b)->strain_energy()), 1e-15);
}

TEST(HalfWidth, NeedsAnEvenNumberOfCellsAndLoadsInTheWheelsPlane) {
  auto model = wheel(1, 2);
  EXPECT_TRUE(HalfWidthSolver::can_halve(model));
  model.grid.cells[2] = 3;
  EXPECT_FALSE(HalfWidthSolver::can_halve(model));
  model.grid.cells[2] = 2;
  model.camber = 0.01;
  EXPECT_FALSE(HalfWidthSolver::can_halve(model));
}

TEST(HalfWidth, GradientPassesTheTaylorTest) {
  const auto model = wheel(1, 4);
  const auto half = HalfWidthSolver::create(model);
  ASSERT_TRUE(half);
  const auto psi = waisted_hole(model.grid);
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::cos(60 * (p[2] - 0.06)));
  }
  const auto test = taylor_test<3>(
      [&](const LevelSet<3>& shape) {
        return testing::evaluate_objective<3>(**half, {{1, std::make_shared<StrainEnergy<3>>()}}, shape);
      },
      psi, direction, model.degree, 2e-5, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  for (double order : test->orders) EXPECT_GT(order, 1.9);
}

}  // namespace
}  // namespace wheelwright
