#include "wheelwright/mechanics/ring/surface_compliance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

template <int dim>
RollingModel<dim> small_model(int degree) {
  RollingModel<dim> model;
  model.grid.inner_radius = 0.20;
  model.grid.outer_radius = 0.34;
  model.grid.width = 0.12;
  model.grid.n_sectors = 6;
  model.grid.cells[0] = 7;
  model.grid.cells[1] = 10;
  if constexpr (dim == 3) model.grid.cells[2] = 2;
  model.degree = degree;
  model.materials = Material{200e6, 0.3};
  model.contact.friction = 0.3;
  model.contact_points = 3;
  model.load = dim == 2 ? 25000 : 3000;
  model.n_positions = 3;
  return model;
}

/// Round holes; in 3D not symmetric across the width.
template <int dim>
LevelSet<dim> shape_with(const RollingModel<dim>& model, const std::vector<Circle>& circles) {
  auto psi = make_level_set<dim>(Lattice<dim>(model.grid, 1), std::span(circles));
  if constexpr (dim == 3)
    for (int i = 0; i < psi.lattice.n_nodes(); ++i)
      psi.values[i] += 0.003 * std::sin(15 * psi.lattice.polar_point(i)[2]);
  return psi;
}

template <int dim>
LevelSet<dim> unsymmetric_shape(const RollingModel<dim>& model) {
  return shape_with<dim>(model, {{0.265, 0.02, 0.030}, {0.27, 0.55, 0.027}});
}

template <int dim>
LevelSet<dim> symmetric_shape(const RollingModel<dim>& model) {
  const double angle = model.grid.sector_angle();
  return shape_with<dim>(model,
                         {{0.265, 0, 0.030}, {0.262, 0.31 * angle, 0.025}, {0.262, 0.69 * angle, 0.025}});
}

template <int dim>
void expect_one_result_of_all_routes(const RollingModel<dim>& model, const LevelSet<dim>& psi,
                                     const std::vector<bool>& loaded) {
  const auto problem = RollingProblem<dim>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(psi);
  ASSERT_TRUE(s);
  constexpr int width = 6;
  const SurfaceCompliance<dim> solved(s->ring, problem->tread(), width, loaded, ComplianceRoute::solve_seams);
  for (const ComplianceRoute route : {ComplianceRoute::invert_outer_line, ComplianceRoute::map_harmonics}) {
    SCOPED_TRACE(static_cast<int>(route));
    const SurfaceCompliance<dim> other(s->ring, problem->tread(), width, loaded, route);
    EXPECT_EQ(other.route(), route);
    int n_seams = 0;
    for (int seam = 0; seam < model.grid.columns(); ++seam) {
      const Matrix& expected = solved.responses(seam);
      Matrix difference = other.responses(seam);
      ASSERT_EQ(difference.entries().size(), expected.entries().size());
      if (expected.entries().empty()) continue;
      ++n_seams;
      for (size_t k = 0; k < difference.entries().size(); ++k)
        difference.entries()[k] -= expected.entries()[k];
      EXPECT_LT(largest_entry(difference), 1e-12 * largest_entry(expected)) << seam;
    }
    EXPECT_GE(n_seams, 3);
  }
}

TEST(SurfaceCompliance, IsTheSameByAllRoutes) {
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    auto plane = small_model<2>(degree);
    plane.tread.levels = 2;
    std::vector<bool> some(plane.grid.columns(), false);
    some[0] = some[1] = some[7] = true;
    expect_one_result_of_all_routes<2>(plane, unsymmetric_shape(plane), some);
    expect_one_result_of_all_routes<2>(plane, symmetric_shape(plane), std::vector<bool>(10, true));
  }
  const auto spatial = small_model<3>(1);
  expect_one_result_of_all_routes<3>(spatial, unsymmetric_shape(spatial), std::vector<bool>(10, true));
  auto even = symmetric_shape(spatial);
  const int n_line = even.lattice.n_nodes();
  for (int i = 0; i < n_line; ++i) even.values[i] -= 0.003 * std::sin(15 * even.lattice.polar_point(i)[2]);
  expect_one_result_of_all_routes<3>(spatial, even, std::vector<bool>(10, true));
}

// Maxwell and Betti: what seam b does under a unit load on seam a, a does under one on b. On a symmetric
// wheel one of the two is computed and the other one is a mirror image.
template <int dim>
void expect_reciprocity(const RollingModel<dim>& model, const LevelSet<dim>& psi, bool is_symmetric) {
  const auto problem = RollingProblem<dim>::create(model);
  ASSERT_TRUE(problem);
  const auto s = problem->solve(psi);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->ring.is_mirror_symmetric(), is_symmetric);
  constexpr int width = 5;
  const SurfaceCompliance<dim> surface(s->ring, problem->tread(), width);
  const int n = problem->tread().n_seam();
  double largest = 0, error = 0;
  for (int seam = 0; seam < model.grid.columns(); ++seam)
    for (int d = -width; d <= width; ++d)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Matrix &here = surface.responses(seam),
                       &there = surface.responses(wrap(seam + d, model.grid.columns()));
          const double a = here(n * (width + 1 + d) + i, j), b = there(n * (width + 1 - d) + j, i);
          largest = std::max(largest, std::abs(a));
          error = std::max(error, std::abs(a - b));
        }
  EXPECT_LT(error, 1e-12 * largest);
}

TEST(SurfaceCompliance, IsReciprocal) {
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    auto plane = small_model<2>(degree);
    plane.tread.levels = 1;
    expect_reciprocity<2>(plane, symmetric_shape(plane), true);
    expect_reciprocity<2>(plane, unsymmetric_shape(plane), false);
    const auto spatial = small_model<3>(degree);
    expect_reciprocity<3>(spatial, symmetric_shape(spatial), true);
  }
}

// z - gamma (g n_y - m) = F W Phi on the zone must be what the solution's own tread observes there, which is
// computed without the contact operator.
TEST(SurfaceCompliance, AgreesWithTheTreadsObservations) {
  for (const int levels : {0, 2}) {
    auto model = small_model<2>(2);
    model.tread.levels = levels;
    model.torque = 300;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto s = problem->solve(unsymmetric_shape(model));
    ASSERT_TRUE(s);
    const ObservationRows<2> rows = problem->tread().observation_rows();
    const int n_columns = model.grid.ring_columns(), per_column = rows.n_points;
    for (size_t position = 0; position < s->contacts.size(); ++position) {
      const auto& contact = s->contacts[position];
      const auto& state = s->states[position];
      double largest = 0, error = 0;
      for (int i = 0; i < contact.n_points(); ++i) {
        const auto& point = contact.points()[i];
        const int column = wrap(contact.zone().first_column + i / per_column, n_columns), q = i % per_column;
        const double* observed = s->observations.column(static_cast<int>(position) * n_columns + column);
        Vec<2> seen;
        for (int d = 0; d < 2; ++d)
          seen[d] = observed[rows.traction(q) + d] - point.gamma * observed[rows.displacement(q) + d];
        seen = point.frame.to_ground<2>(seen);
        const Vec<2> motion = displacement<2>(state.rim, point.position);
        for (int d = 0; d < 2; ++d) {
          const double reply = state.augmented[i][d] + point.gamma * (motion[d] - (d == 0 ? point.gap : 0.0));
          largest = std::max(largest, std::abs(reply));
          error = std::max(error, std::abs(reply - seen[d]));
        }
      }
      EXPECT_LT(error, 1e-10 * largest);
    }
  }
}

}  // namespace
}  // namespace wheelwright
