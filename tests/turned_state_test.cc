#include "wheelwright/mechanics/rolling/turned_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/rolling/ring_state.h"
#include "wheelwright/mechanics/rolling/width_halves.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/moved_lines.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

template <int dim>
RollingModel<dim> wheel() {
  RollingModel<dim> model;
  model.grid.inner_radius = 0.20;
  model.grid.outer_radius = 0.34;
  model.grid.width = 0.12;
  model.grid.n_sectors = 16;
  if constexpr (dim == 2)
    model.grid.cells = {14, 12};
  else
    model.grid.cells = {8, 7, 2};
  model.degree = dim == 2 ? 2 : 1;
  model.materials = Material{200e6, 0.3};
  model.load = dim == 2 ? 24525 : 2943;
  model.contact.friction = 0.5;
  model.torque = dim == 2 ? 700 : 80;
  model.distributed.body_force = {3e4, 1e4};
  model.distributed.hole_pressure = 2e4;
  model.n_positions = 3;
  model.contact_points = 3;
  model.tread.annulus_points = 2;
  return model;
}

/// A hole across the first azimuth of the sector, so that a sector is better cut elsewhere.
template <int dim>
LevelSet<dim> hole_on_the_border(const PolarGrid<dim>& grid) {
  const double angle = grid.sector_angle();
  const Circle holes[] = {{0.2581, 0.08 * angle, 0.0253}, {0.2581, 1.08 * angle, 0.0253}};
  auto psi = make_level_set<dim>(Lattice<dim>(grid, 1), holes);
  if constexpr (dim == 3)
    for (int i = 0; i < psi.lattice.n_nodes(); ++i)
      psi.values[i] += 0.003 * std::cos(20 * psi.lattice.polar_point(i)[2]);
  return psi;
}

double difference(std::span<const double> a, std::span<const double> b) {
  double difference = 0, size = 0;
  for (size_t i = 0; i < b.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    if (std::isnan(a[i]) || std::isnan(b[i])) return INFINITY;
    difference = std::max(difference, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return a.size() == b.size() ? difference / size : INFINITY;
}

/// How a function depends on the states, with nothing left out.
template <int dim>
FunctionalDerivative<dim> some_derivative(const State<dim>& state) {
  FunctionalDerivative<dim> derivative;
  for (int i = 0; i < state.positions().size(); ++i) {
    derivative.energy.push_back(1 + 0.3 * i);
    derivative.rim.push_back({2e3 + 1e3 * i, 0, 7e3, 0});
    derivative.tractions.emplace_back();
    for (size_t q = 0; q < state.contacts()[i].points.size(); ++q) {
      Vec<dim> t{};
      t[0] = 1e-8 * std::sin(double(q) + i);
      t[1] = 2e-8 * std::cos(double(q));
      derivative.tractions.back().push_back(t);
    }
  }
  derivative.tread_loads = Matrix(state.observations().rows(), state.observations().columns());
  for (int j = 0; j < derivative.tread_loads.columns(); ++j)
    for (int k = 0; k < 4; ++k) derivative.tread_loads(k, j) = std::sin(0.7 * j + k);
  return derivative;
}

/// The density at the boundary's points, by their places.
template <int dim>
std::vector<double> moments(const State<dim>& state, const std::vector<double>& density) {
  const PolarGrid<dim>& grid = state.domain().grid;
  std::vector<double> result(4, 0.0);
  for (size_t k = 0; k < density.size(); ++k) {
    const auto& point = state.boundary()[k];
    const auto cell = grid.cell_position(point.cell);
    const double weighted = point.weight * density[k], azimuth = cell[1] + point.xi[1];
    result[0] += weighted;
    result[1] += weighted * std::cos(azimuth);
    result[2] += weighted * (cell[0] + point.xi[0]) * std::sin(azimuth);
    result[3] += weighted * point.normal[1];
  }
  return result;
}

template <int dim>
void expect_the_same(const State<dim>& a, const State<dim>& b) {
  constexpr double rounding = 1e-9;
  EXPECT_LT(difference(a.strain_energy(), b.strain_energy()), rounding);
  EXPECT_LT(difference(a.observations().entries(), b.observations().entries()), rounding);
  for (int i = 0; i < b.positions().size(); ++i) {
    EXPECT_EQ(a.positions().grounds[i].column, b.positions().grounds[i].column);
    EXPECT_LT(difference(a.displacement().at_nodes(i).values, b.displacement().at_nodes(i).values), rounding);
    const auto &one = a.contacts()[i].points, &other = b.contacts()[i].points;
    ASSERT_EQ(one.size(), other.size());
    for (size_t q = 0; q < one.size(); ++q) {
      const int n = b.domain().grid.ring_columns();
      EXPECT_EQ(wrap(one[q].column, n), wrap(other[q].column, n));
      EXPECT_EQ(one[q].point, other[q].point);
      for (int d = 0; d < dim; ++d) {
        EXPECT_NEAR(one[q].position[d], other[q].position[d], 1e-14);
        EXPECT_NEAR(one[q].traction[d], other[q].traction[d], 1.0);  // [Pa] of a MPa
      }
    }
  }
  Vec<dim> place;
  place.fill(0.3);
  for (int cell = 0; cell < b.domain().grid.n_cells(); ++cell)
    if (b.domain().kinds[cell] == CellKind::inside) {
      EXPECT_LT(difference(a.displacement().strains(cell, std::span(&place, 1)).by_rows().entries(),
                           b.displacement().strains(cell, std::span(&place, 1)).by_rows().entries()),
                1e-7);
      EXPECT_LT(
          difference(a.displacement().strains_and_rotations(cell, std::span(&place, 1)).by_rows().entries(),
                     b.displacement().strains_and_rotations(cell, std::span(&place, 1)).by_rows().entries()),
          1e-7);
    }
  EXPECT_LT(difference(a.strain_peaks().von_mises, b.strain_peaks().von_mises), rounding);
  for (size_t i = 0; i < a.strain_peaks().von_mises_places.size(); ++i)
    EXPECT_NEAR(a.strain_peaks().von_mises_places[i][1], b.strain_peaks().von_mises_places[i][1], 1e-12);
  const auto derivative = some_derivative(b);
  const auto of_a = a.shape_gradients(std::span(&derivative, 1)),
             of_b = b.shape_gradients(std::span(&derivative, 1));
  ASSERT_TRUE(of_a && of_b);
  EXPECT_LT(difference(moments(a, of_a->densities[0]), moments(b, of_b->densities[0])), 1e-7);
}

template <int dim>
void expect_that_turning_changes_nothing(const RollingModel<dim>& model, const LevelSet<dim>& psi) {
  const auto problem = RollingProblem<dim>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto positions = problem->all_positions();
  auto domain = cut_domain(psi, model.points_in_cut_cells());
  ASSERT_TRUE(domain);
  const auto columns = possible_first_columns(model.grid, is_mirror_symmetric(psi));
  EXPECT_GT(best_first_column(*domain, problem->elements(), problem->core_rows(), columns), 0);
  const auto turned = problem->states(psi, positions, {});
  auto solved = problem->solve(psi, positions);
  ASSERT_TRUE(turned) << turned.failure().detail;
  ASSERT_TRUE(solved) << solved.failure().detail;
  const auto as_it_is = ring_state(*problem, *std::move(solved));
  expect_the_same(**turned, *as_it_is);
  auto heavier = model;
  heavier.load *= 1.3;
  const auto turned_under = (*turned)->under(heavier, {}), under = as_it_is->under(heavier, {});
  ASSERT_TRUE(turned_under && under);
  expect_the_same(**turned_under, **under);
  const auto contacts = (*turned)->contacts_under(std::span(&heavier, 1), {}).front();
  ASSERT_TRUE(contacts);
  EXPECT_NEAR((*contacts)[0].rim.towards_ground / (*under)->contacts()[0].rim.towards_ground, 1, 1e-9);
}

template <int dim>
void expect_that_turning_changes_nothing() {
  const auto model = wheel<dim>();
  expect_that_turning_changes_nothing(model, hole_on_the_border(model.grid));
}

TEST(TurnedState, IsTheStateInThePlane) { expect_that_turning_changes_nothing<2>(); }
TEST(TurnedState, IsTheStateInSpace) { expect_that_turning_changes_nothing<3>(); }

/// Of layers that meet within the hole, between rows of unequal height.
template <int dim>
void expect_that_turning_changes_nothing_in_layers() {
  auto model = wheel<dim>();
  const auto law = [](double modulus) { return std::make_shared<IsotropicLaw<dim>>(Material{modulus, 0.3}); };
  model.materials = Materials<dim>(std::vector<typename Materials<dim>::Layer>{
      {0.2513, law(200e6)}, {0.2711, law(20e6)}, {0, law(200e6)}});
  model.grid = with_lines_at(model.grid, model.materials.interfaces());
  EXPECT_EQ(model.grid.fixed_lines.size(), 2u);
  expect_that_turning_changes_nothing(model, hole_on_the_border(model.grid));
}
TEST(TurnedState, OfLayersIsTheStateInThePlane) { expect_that_turning_changes_nothing_in_layers<2>(); }
TEST(TurnedState, OfLayersIsTheStateInSpace) { expect_that_turning_changes_nothing_in_layers<3>(); }

/// A wheel with mirror planes, one of them in the middle of a hole on the border of the sector.
template <int dim>
struct SymmetricWheel {
  SymmetricWheel() {
    model.grid.cells[1] = 8;
    const Circle hole{0.2581, 0, 0.0253};
    psi = mirror_symmetric_part(make_level_set<dim>(Lattice<dim>(model.grid, 1), std::span(&hole, 1)));
  }
  RollingModel<dim> model = wheel<dim>();
  LevelSet<dim> psi{Lattice<dim>(model.grid, 1), {}};
};

TEST(TurnedState, ByHalfASectorIsTheStateInThePlane) {
  const SymmetricWheel<2> wheel;
  expect_that_turning_changes_nothing(wheel.model, wheel.psi);
}
TEST(TurnedState, ByHalfASectorIsTheStateInSpace) {
  const SymmetricWheel<3> wheel;
  expect_that_turning_changes_nothing(wheel.model, wheel.psi);
}

template <int dim>
void expect_that_half_a_sector_keeps_the_mirror_planes() {
  SymmetricWheel<dim> wheel;
  wheel.model.torque = wheel.model.contact.friction = 0;
  wheel.model.distributed.body_force = {};
  const auto problem = RollingProblem<dim>::create(wheel.model);
  ASSERT_TRUE(problem);
  const auto domain = cut_domain(wheel.psi, wheel.model.points_in_cut_cells());
  const int half = wheel.model.grid.columns() / 2;
  const auto back = turned_back(wheel.psi, *domain, half);
  EXPECT_TRUE(is_mirror_symmetric(back.psi));
  const auto ring = problem->solve({back.psi, &back.domain});
  ASSERT_TRUE(ring);
  EXPECT_TRUE(ring->ring.is_mirror_symmetric());

  // Positions that represent their images.
  const auto positions = problem->distinct_positions(wheel.psi);
  EXPECT_TRUE(positions.stand_for_images());
  const auto turned = problem->states(wheel.psi, positions, {});
  auto solved = problem->solve(wheel.psi, positions);
  ASSERT_TRUE(turned && solved);
  const auto as_it_is = ring_state(*problem, *std::move(solved));
  EXPECT_LT(difference((*turned)->strain_energy(), as_it_is->strain_energy()), 1e-10);
  FunctionalDerivative<dim> energy;
  energy.energy.assign(positions.size(), 1);
  const auto gradient = (*turned)->shape_gradients(std::span(&energy, 1)),
             expected = as_it_is->shape_gradients(std::span(&energy, 1));
  ASSERT_TRUE(gradient && expected);
  EXPECT_LT(difference(moments(**turned, gradient->densities[0]), moments(*as_it_is, expected->densities[0])),
            1e-8);
}
TEST(TurnedState, ByHalfASectorKeepsMirrorPlanesInThePlane) {
  expect_that_half_a_sector_keeps_the_mirror_planes<2>();
}
TEST(TurnedState, ByHalfASectorKeepsMirrorPlanesInSpace) {
  expect_that_half_a_sector_keeps_the_mirror_planes<3>();
}

// Ghost faces couple nodes past the sector's face, of which the middle of the width holds some.
TEST(TurnedState, HalfOfAWheelWithHolesAcrossFacesHasRealHarmonics) {
  SymmetricWheel<3> wheel;
  wheel.model.degree = 2;
  wheel.model.torque = wheel.model.contact.friction = 0;
  wheel.model.distributed.body_force = {};
  const auto half = RollingProblem<3>::create(first_half(wheel.model));
  ASSERT_TRUE(half);
  const auto solved = half->solve(first_half(wheel.psi));
  ASSERT_TRUE(solved) << solved.failure().detail;
  EXPECT_TRUE(solved->ring.is_mirror_symmetric());
}

TEST(TurnedState, ASectorIsCutWhereItSharesTheFewestNodes) {
  const auto model = wheel<2>();
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = hole_on_the_border(model.grid);
  const auto domain = cut_domain(psi, model.points_in_cut_cells());
  ASSERT_TRUE(domain);
  const auto interface = [&](int column) {
    const auto turned = turned_back(psi, *domain, column);
    const auto solution = problem->solve({turned.psi, &turned.domain});
    return solution->ring.n_boundary() - solution->ring.n_outer();
  };
  const auto all_columns = possible_first_columns(model.grid, false);
  const int best = best_first_column(*domain, problem->elements(), problem->core_rows(), all_columns);
  for (int column = 0; column < model.grid.columns(); ++column)
    EXPECT_LE(interface(best), interface(column)) << column;
  // Turned further by the same columns it is best at the first one.
  const auto turned = turned_back(psi, *domain, best);
  EXPECT_EQ(best_first_column(turned.domain, problem->elements(), problem->core_rows(), all_columns), 0);
}

}  // namespace
}  // namespace wheelwright
