#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/support.h"
#include "wheelwright/mechanics/ring/tread_ring.h"

namespace wheelwright {
namespace {

using testing::paper_model;

// The ring without holes, converged on four meshes of independent finite elements: rim travel 0.21798 mm,
// peak pressure 2.445 MPa, J_e 2.4892 J/m.
TEST(TreadRefinement, PressuresConvergeOnTheBaseGrid) {
  auto model = paper_model();
  model.n_positions = 1;
  for (int levels : {2, 3}) {
    model.tread.levels = levels;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    LevelSet<2> solid{Lattice<2>(model.grid, 2), {}};
    solid.values.assign(solid.lattice.n_nodes(), -1.0);
    const auto s = problem->solve(solid);
    ASSERT_TRUE(s) << s.failure().detail;
    double peak = 0;
    for (const auto& traction : s->states[0].traction) peak = std::max(peak, -traction[0]);
    EXPECT_NEAR(peak, 2.445e6, 0.005 * 2.445e6) << levels;
    EXPECT_NEAR(s->states[0].rim.towards_ground, 0.21798e-3, 1e-3 * 0.21798e-3) << levels;
    EXPECT_NEAR(s->strain_energy[0], 2.4892, 1e-3 * 2.4892) << levels;
  }
}

/// Largest contact pressure of all positions.
double peak_pressure(const RollingSolution<2>& s) {
  double peak = 0;
  for (const auto& state : s.states)
    for (const auto& traction : state.traction) peak = std::max(peak, -traction[0]);
  return peak;
}

// Hertz's peak pressure is proportional to sqrt(E*), E* = E / (1 - nu^2): 2.445 MPa at nu = 0.48. Positions
// at and between holes: there pressures would fall back between cells if nothing penalized their jumps.
TEST(TreadRefinement, PressuresOfNearlyIncompressibleMaterialMatchHertz) {
  auto model = paper_model();
  LevelSet<2> solid{Lattice<2>(model.grid, 2), {}};
  solid.values.assign(solid.lattice.n_nodes(), -1.0);
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const std::vector shapes{solid, testing::paper_holes(model.grid)};
    const double expected = 2.445e6 * std::sqrt((1 - 0.48 * 0.48) / (1 - nu * nu));
    for (const int levels : {2, 3}) {
      model.materials = Material{200e6, nu};
      model.tread.levels = levels;
      const auto problem = RollingProblem<2>::create(model);
      ASSERT_TRUE(problem);
      for (const auto& psi : shapes) {
        const auto s = problem->solve(psi);
        ASSERT_TRUE(s) << s.failure().detail;
        EXPECT_NEAR(peak_pressure(*s), expected, 0.01 * expected) << nu << ", " << levels << " levels";
      }
    }
  }
}

// Inner unknowns come from a Cholesky solve, whose rounding is at most n eps kappa of them: n = 4, 24, 160
// inner unknowns, and kappa = 2.9e2, 2.2e3, 2.0e4 the condition of their stiffness, scaled to a unit
// diagonal. Without a defect about eps kappa is left, 4e-12 for the last. A weight of a hanging node that is
// wrong by 1e-6 changes displacements by 1e-7.
TEST(TreadRefinement, HangingNodesKeepRigidMotionsFreeOfForce) {
  auto model = paper_model(7, 96);
  for (const auto& [levels, rounding] : {std::pair{0, 2.5e-13}, {1, 1.2e-11}, {3, 7e-10}}) {
    const ElementTable<2> table(model.grid, 2, model.materials, model.ghost);
    const auto column = tread_column<2>(table, {1, levels, 0}, model.contact, 5);
    ASSERT_TRUE(column);
    // A translation along the column's first radius: polar components turn with the node. The condensed
    // column knows base and both lines; their azimuths are 0, half and one column angle.
    const double angle = model.grid.column_angle();
    const int n_line_nodes = column->n_line / 2;
    std::vector<double> u;
    for (int line = 0; line <= 2; ++line) {
      u.push_back(std::cos(0.5 * line * angle));
      u.push_back(-std::sin(0.5 * line * angle));
    }
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n_line_nodes; ++i) {
        u.push_back(std::cos(side * angle));
        u.push_back(-std::sin(side * angle));
      }
    ASSERT_EQ(static_cast<int>(u.size()), column->stiffness.rows());
    double scale = 0;
    for (double k : column->stiffness.entries()) scale = std::max(scale, std::abs(k));
    for (int i = 0; i < column->stiffness.rows(); ++i) {
      double force = 0;
      for (size_t j = 0; j < u.size(); ++j) force += column->stiffness(i, static_cast<int>(j)) * u[j];
      EXPECT_LT(std::abs(force), 1e-11 * scale);
    }
    const int body_row = column->observation.rows() - 2;
    for (int c = 0; c < 2; ++c) {
      double integral = 0;
      for (size_t j = 0; j < u.size(); ++j)
        integral += column->observation(body_row + c, static_cast<int>(j)) * u[j];
      EXPECT_NEAR(integral, c == 0 ? column->volume : 0, rounding * column->volume);
    }
    for (int q = 0; q < body_row; ++q) {
      double observed = 0;
      for (size_t j = 0; j < u.size(); ++j) observed += column->observation(q, static_cast<int>(j)) * u[j];
      const double expected = q % 4 == 0 ? 1 : 0;
      EXPECT_NEAR(observed, expected, q % 4 < 2 ? rounding : rounding * scale / model.grid.resolution());
    }
  }
}

Matrix random_matrix(int rows, int columns, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Matrix a(rows, columns);
  for (double& x : a.entries()) x = uniform(random);
  return a;
}

double inner_product(const Matrix& a, const Matrix& b) {
  return std::inner_product(a.entries().begin(), a.entries().end(), b.entries().begin(), 0.0);
}

// Right-hand sides with loads on no, some and all columns, more columns than one range of those taken
// together.
TEST(TreadRing, IsReciprocalAndTheSameInSomeColumnsAsInAll) {
  auto model = paper_model(7, 384);
  const ElementTable<2> table(model.grid, 2, model.materials, model.ghost);
  const auto tread = Tread<2>::condense(table, model.tread, model.contact, 5);
  ASSERT_TRUE(tread);
  const int n_rhs = 40, n_columns = tread->n_columns(), n_sectors = model.grid.n_sectors;
  std::mt19937 random(3);
  const Matrix outer =
      random_matrix(tread->columns_per_sector() * tread->base_per_column(), n_rhs * n_sectors, random);
  Matrix observation_loads(tread->n_observations(), n_rhs * n_columns);
  const auto load = [&](int column) {
    const Matrix entries = random_matrix(observation_loads.rows(), 1, random);
    std::copy_n(entries.data(), entries.rows(), observation_loads.column(column));
  };
  for (int c : {0, 5, n_columns - 1}) load(n_columns + c);
  for (int c = 2 * n_columns; c < observation_loads.columns(); ++c) load(c);
  const TreadLoads loads = tread_loads(*tread, observation_loads);
  const TreadLoads none = tread_loads(*tread, Matrix(observation_loads.rows(), observation_loads.columns()));

  // Betti: the loads do as much work on what the base makes of the tread as their reactions on the base.
  const Matrix of_base = observations(*tread, tread_field(*tread, outer, none), none);
  const double work = inner_product(observation_loads, of_base);
  EXPECT_NEAR(inner_product(base_loads(*tread, loads), outer), work, 1e-11 * std::abs(work));

  const TreadField field = tread_field(*tread, outer, loads);
  const Matrix all = observations(*tread, field, loads);
  const std::vector<int> columns{n_columns + 5, 7, 3 * n_columns, 2 * n_columns - 1, n_rhs * n_columns - 1};
  const Matrix some = observations(*tread, field, loads, columns);
  for (size_t k = 0; k < columns.size(); ++k)
    for (int i = 0; i < all.rows(); ++i)
      EXPECT_NEAR(some(i, static_cast<int>(k)), all(i, columns[k]), 1e-12 * largest_entry(all));
}

}  // namespace
}  // namespace wheelwright
