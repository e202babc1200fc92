#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "wheelwright/mechanics/elasticity/isotropic_law.h"
#include "wheelwright/mechanics/hyperelastic/element.h"
#include "wheelwright/mechanics/hyperelastic/element_table.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"

namespace wheelwright {
namespace {

constexpr double modulus = 8e6;

template <int dim>
PolarGrid<dim> coarse_grid() {
  PolarGrid<dim> grid;
  grid.inner_radius = 0.2;
  grid.outer_radius = 0.34;
  grid.width = 0.12;
  grid.n_sectors = 5;
  grid.cells.fill(3);
  return grid;
}

template <int dim>
HyperelasticElement<dim> element(int degree, const StoredEnergy& energy, double ratio,
                                 Plane plane = Plane::strain) {
  return {coarse_grid<dim>(), degree, 1, energy, {modulus, ratio, plane}};
}

/// The part of a cell below a plane.
template <int dim>
std::vector<ReferencePoint<dim>> part_of_cell() {
  auto rule = unit_cell_rule<dim>(4);
  std::erase_if(rule, [](const ReferencePoint<dim>& q) { return q.xi[0] + 0.7 * q.xi[1] > 1.1; });
  return rule;
}

/// Displacements with strains of about 0.2.
std::vector<double> displacements(int n, double size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> u(n);
  for (double& x : u) x = uniform(random);
  return u;
}

template <int dim>
void expect_derivatives(int degree, const StoredEnergy& energy, double ratio, bool projects) {
  constexpr double step = 1e-7;
  const auto cell = element<dim>(degree, energy, ratio);
  EXPECT_EQ(cell.projected_lambda() > 0, projects);
  const auto points = cell.points(part_of_cell<dim>());
  const int n = cell.n_dofs();
  const auto u = displacements(n, 1.5e-3);
  typename HyperelasticElement<dim>::Dofs forces, above, below;
  auto tangent = std::make_unique<typename HyperelasticElement<dim>::Block>();
  const double value = cell.tangent(points, u.data(), forces, *tangent);
  EXPECT_GT(value, 0);
  EXPECT_NEAR(cell.energy(points, u.data()), value, 1e-12 * value);
  const double stiffness = *std::max_element(tangent->begin(), tangent->begin() + n * n);
  for (int k = 0; k < n; ++k) {
    auto more = u, less = u;
    more[k] += step;
    less[k] -= step;
    const double difference =
        (cell.forces(points, more.data(), above) - cell.forces(points, less.data(), below)) / (2 * step);
    EXPECT_NEAR(difference, forces[k], 1e-7 * stiffness * 1e-3);
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR((above[i] - below[i]) / (2 * step), (*tangent)[k * n + i], 1e-6 * stiffness);
      EXPECT_NEAR((*tangent)[i * n + k], (*tangent)[k * n + i], 1e-12 * stiffness);
    }
  }
}

TEST(HyperelasticElement, ForcesAndTangentAreDerivativesOfItsEnergy) {
  for (const auto& [form, ratio, projects] :
       {std::tuple(EnergyForm::neo_hookean, 0.3, false), std::tuple(EnergyForm::neo_hookean, 0.499, true),
        std::tuple(EnergyForm::mooney_rivlin, 0.45, true),
        std::tuple(EnergyForm::saint_venant_kirchhoff, 0.48, false)}) {
    const StoredEnergy energy = StoredEnergy::of({modulus, ratio}, form, 0.3);
    expect_derivatives<2>(1, energy, ratio, false);
    expect_derivatives<2>(2, energy, ratio, projects);
    expect_derivatives<3>(1, energy, ratio, false);
  }
  expect_derivatives<3>(2, StoredEnergy::of({modulus, 0.48}), 0.48, true);
}

/// For small displacements it is the element of linear elasticity, projected or not, cut or not.
template <int dim>
void expect_linear_element(int degree, const Material& material, EnergyForm form) {
  const auto cell =
      element<dim>(degree, StoredEnergy::of(material, form, 0.3), material.poissons_ratio, material.plane);
  const bool projects_linear = cell.small_strains().projected_lambda() > 0;
  if (projects_linear != (cell.projected_lambda() > 0)) return;  // other forms are not projected
  const auto part = part_of_cell<dim>();
  const std::vector<double> zero(cell.n_dofs(), 0.0);
  typename HyperelasticElement<dim>::Dofs forces;
  auto tangent = std::make_unique<typename HyperelasticElement<dim>::Block>();
  cell.tangent(cell.points(part), zero.data(), forces, *tangent);
  const Matrix expected = cell_stiffness<dim>(cell.small_strains(), IsotropicLaw<dim>(material), part);
  const double size = largest_entry(expected);
  for (int i = 0; i < cell.n_dofs(); ++i) {
    EXPECT_NEAR(forces[i], 0, 1e-16 * size);
    for (int k = 0; k < cell.n_dofs(); ++k)
      EXPECT_NEAR((*tangent)[i * cell.n_dofs() + k], expected(i, k), 1e-12 * size);
  }
}

TEST(HyperelasticElement, IsTheLinearElementForSmallDisplacements) {
  for (const double ratio : {0.3, 0.45, 0.4999})
    for (const EnergyForm form : {EnergyForm::neo_hookean, EnergyForm::mooney_rivlin,
                                  EnergyForm::saint_venant_kirchhoff, EnergyForm::small_strain}) {
      for (const int degree : {1, 2}) {
        expect_linear_element<2>(degree, {modulus, ratio}, form);
        expect_linear_element<2>(degree, {modulus, ratio, Plane::stress}, form);
      }
      expect_linear_element<3>(1, {modulus, ratio}, form);
    }
  expect_linear_element<3>(2, {modulus, 0.48}, EnergyForm::neo_hookean);
}

/// The displacement that turns the deformed cell about the axle, on its dofs.
template <int dim>
std::vector<double> turned(const HyperelasticElement<dim>& cell, int degree, const std::vector<double>& u,
                           double angle) {
  const PolarGrid<dim> grid = coarse_grid<dim>();
  const Lattice<dim> lattice(grid, degree);
  std::vector<double> result(u.size());
  for (int a = 0; a < cell.n_nodes(); ++a) {
    Vec<dim> local;
    for (int c = 0; c < dim; ++c) local[c] = u[cell.dof(a, c)];
    const auto polar = lattice.polar_point(lattice.cell_node({1}, a));
    const Vec<dim> x = cartesian<dim>(polar), deformed = x + rotated<dim>(local, polar[1]);
    const Vec<dim> moved = rotated<dim>(rotated<dim>(deformed, angle) - x, -polar[1]);
    for (int c = 0; c < dim; ++c) result[cell.dof(a, c)] = moved[c];
  }
  return result;
}

template <int dim>
void expect_objectivity(int degree, const StoredEnergy& energy, double ratio) {
  const auto cell = element<dim>(degree, energy, ratio);
  const auto points = cell.points(part_of_cell<dim>());
  const auto u = displacements(cell.n_dofs(), 2e-3), moved = turned<dim>(cell, degree, u, 0.9);
  typename HyperelasticElement<dim>::Dofs forces, moved_forces;
  const double value = cell.forces(points, u.data(), forces),
               moved_value = cell.forces(points, moved.data(), moved_forces);
  EXPECT_NEAR(moved_value, value, 1e-11 * value);
  double size = 0;
  for (const double f : forces) size = std::max(size, std::abs(f));
  for (int a = 0; a < cell.n_nodes(); ++a) {
    Vec<2> before{forces[cell.dof(a, 0)], forces[cell.dof(a, 1)]};
    before = rotated<2>(before, 0.9);
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(moved_forces[cell.dof(a, c)], before[c], 1e-10 * size);
  }
}

TEST(HyperelasticElement, ARotationOfTheDeformedCellTurnsItsForces) {
  for (const double ratio : {0.3, 0.48})
    for (const EnergyForm form :
         {EnergyForm::neo_hookean, EnergyForm::saint_venant_kirchhoff, EnergyForm::mooney_rivlin}) {
      expect_objectivity<2>(2, StoredEnergy::of({modulus, ratio}, form, 0.3), ratio);
      expect_objectivity<3>(1, StoredEnergy::of({modulus, ratio}, form, 0.3), ratio);
    }
}

TEST(HyperelasticElement, TurnedInsideOutIsAnInfiniteEnergy) {
  for (const double ratio : {0.3, 0.48}) {
    const auto cell = element<2>(2, StoredEnergy::of({modulus, ratio}), ratio);
    const auto u = displacements(cell.n_dofs(), 0.1);
    HyperelasticElement<2>::Dofs forces;
    EXPECT_EQ(cell.energy(cell.points(part_of_cell<2>()), u.data()), INFINITY);
    EXPECT_EQ(cell.forces(cell.points(part_of_cell<2>()), u.data(), forces), INFINITY);
  }
}

TEST(HyperelasticElement, TheTractionsTangentIsItsDerivative) {
  constexpr double step = 1e-7;
  for (const double ratio : {0.3, 0.499}) {
    const auto cell = element<2>(2, StoredEnergy::of({modulus, ratio}), ratio);
    const auto points = cell.points(unit_cell_rule<2>(4));
    const Vec<2> normal{0.8, 0.6};
    const auto point = cell.at({1, 0.3});
    const auto traction = [&](const std::vector<double>& u) {
      const auto r = cell.response_at(point, cell.deformation(point, cell.cartesian(u.data())),
                                      cell.projected_volume(points, u.data()));
      return Vec<2>{dot(r.piola[0], normal), dot(r.piola[1], normal)};
    };
    const auto u = displacements(cell.n_dofs(), 2e-3);
    const auto volume = cell.projected_volume(points, u.data());
    const Mat<2> f = cell.deformation(point, cell.cartesian(u.data()));
    const auto tangent = cell.traction_tangent(point, cell.response_at(point, f, volume), f, volume, normal);
    const double size = largest_magnitude(std::span(tangent[0]).first(cell.n_dofs()));
    for (int k = 0; k < cell.n_dofs(); ++k) {
      auto more = u, less = u;
      more[k] += step;
      less[k] -= step;
      const Vec<2> difference = (traction(more) - traction(less)) / (2 * step);
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(difference[i], tangent[i][k], 1e-6 * size);
    }
  }
}

/// The dofs of two neighbouring cells for an affine displacement, and its energy by the ghost penalty.
template <int dim>
void expect_no_ghosts_of_affine_displacements(int degree) {
  const PolarGrid<dim> grid = coarse_grid<dim>();
  const Materials<dim> material(std::make_shared<HyperelasticLaw<dim>>(Material{modulus, 0.3}));
  const auto table = HyperelasticTable<dim>::create(grid, degree, material, GhostPenalty{});
  ASSERT_TRUE(table);
  Mat<dim> gradient{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) gradient[i][j] = 0.3 * std::sin(1 + 3 * i + j);
  const Lattice<dim> lattice(grid, degree);
  for (int axis = 0; axis < dim; ++axis) {
    const Matrix& ghost = table->face_ghost(1, axis);
    Matrix u(ghost.rows(), 1), rough(ghost.rows(), 1);
    const int n = nodes_per_cell<dim>(degree);
    for (int side = 0; side < 2; ++side)
      for (int a = 0; a < n; ++a) {
        std::array<int, dim> place{};
        place.fill(1);
        place[axis] += side;
        const auto polar = lattice.polar_point(lattice.cell_node(place, a));
        const Vec<dim> x = cartesian<dim>(polar);
        Vec<dim> at;
        for (int i = 0; i < dim; ++i) at[i] = 0.1 + dot(gradient[i], x);
        at = rotated<dim>(at, -polar[1]);
        for (int c = 0; c < dim; ++c) {
          u(dim * (side * n + a) + c, 0) = at[c];
          rough(dim * (side * n + a) + c, 0) = std::sin(a + side + c);
        }
      }
    const auto work = [&](const Matrix& v) {
      return product(v, Op::transpose, product(ghost, Op::none, v, Op::none), Op::none)(0, 0);
    };
    EXPECT_NEAR(work(u), 0, 1e-14 * largest_entry(ghost));
    EXPECT_GT(work(rough), 0.01 * largest_entry(ghost));
  }
}

TEST(HyperelasticElement, GhostsDoNotFeelAffineDisplacementsNorRotations) {
  for (const int degree : {1, 2}) {
    expect_no_ghosts_of_affine_displacements<2>(degree);
    expect_no_ghosts_of_affine_displacements<3>(degree);
  }
}

}  // namespace
}  // namespace wheelwright
