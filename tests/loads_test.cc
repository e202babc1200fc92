#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/sensitivity/taylor_test.h"

namespace wheelwright {
namespace {

using testing::generic_taylor_test;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;
using testing::strain_energy_alone;

/// Loads of the size of the wheel's own.
DistributedLoads<2> strong_loads() { return {{1e5, 3e4}, 3e4}; }

LevelSet<2> solid(const PolarGrid<2>& grid) {
  LevelSet<2> psi{Lattice<2>(grid, 2), {}};
  psi.values.assign(psi.lattice.n_nodes(), -1.0);
  return psi;
}

/// The work of the core's loads at position 0 on a displacement, given by its polar components at (radius,
/// azimuth) in the body frame.
double work_on(const RollingSolution<2>& s, const std::function<Vec<2>(double, double)>& displacement) {
  const SectorSpace<2>& space = s.ring.sector().space;
  const Lattice<2> lattice(space.grid(), space.degree());
  double work = 0;
  for (int sector = 0; sector < space.grid().n_sectors; ++sector)
    for (int node = 0; node < space.n_nodes(); ++node) {
      const Vec<2> p = lattice.polar_point(space.position(node));
      const Vec<2> w = displacement(p[0], p[1] + sector * space.grid().sector_angle());
      for (int c = 0; c < 2; ++c) work += s.core_loads.value(sector, s.ring.row(2 * node + c)) * w[c];
    }
  return work;
}

TEST(Loads, WorkOfABodyForce) {
  auto model = paper_model();
  model.n_positions = 1;
  model.distributed.body_force = {3e4, -2e4};
  const auto problem = RollingProblem<2>::create(model);
  const auto s = problem->solve(solid(model.grid));
  ASSERT_TRUE(s) << s.failure().detail;
  // On (r - R_i)(R - r) along f, R the core's outer radius.
  const double inner = model.grid.inner_radius, outer = model.grid.outer_radius - model.grid.cell_size()[0];
  const auto profile = [&](double r) { return (r - inner) * (outer - r); };
  const Vec<2>& f = model.distributed.body_force;
  const double work = work_on(*s, [&](double r, double azimuth) {
    return rotated<2>({f[0] * profile(r), f[1] * profile(r)}, -azimuth);
  });
  const double expected = dot<2>(f, f) * std::numbers::pi * std::pow(outer - inner, 3) * (inner + outer) / 6;
  EXPECT_NEAR(work, expected, 1e-7 * expected);
}

TEST(Loads, WorkOfAPressureInTheHoles) {
  auto model = paper_model();
  model.n_positions = 1;
  model.distributed.hole_pressure = 2e4;
  const auto problem = RollingProblem<2>::create(model);
  const auto s = problem->solve(paper_holes(model.grid));
  ASSERT_TRUE(s) << s.failure().detail;
  // On (r - R_i^2 / r) e_r, whose divergence is 2: the pressure works on the growth of the holes.
  const double inner = model.grid.inner_radius;
  const double work = work_on(*s, [&](double r, double) { return Vec<2>{r - inner * inner / r, 0}; });
  const double expected = -model.distributed.hole_pressure * -2 * 16 * std::numbers::pi * 0.04 * 0.04;
  EXPECT_NEAR(work, expected, 1e-5 * expected);
}

TEST(Loads, TheGroundCarriesTheWheelToo) {
  for (const double friction : {0.0, 0.3}) {
    auto model = paper_model();
    model.contact.friction = friction;
    if (friction > 0) model.horizontal_force = 0.05 * model.load;
    model.distributed = strong_loads();
    const auto problem = RollingProblem<2>::create(model);
    const auto psi = paper_holes(model.grid);
    const auto s = problem->solve(psi);
    ASSERT_TRUE(s) << s.failure().detail;
    const double volume = 16 * material_measure(psi);
    for (int i = 0; i < model.n_positions; ++i) {
      double normal = 0, along = 0;
      for (int q = 0; q < s->contacts[i].n_points(); ++q) {
        normal += s->contacts[i].points()[q].weight * s->states[i].traction[q][0];
        along += s->contacts[i].points()[q].weight * s->states[i].traction[q][1];
      }
      const double weight = model.load + model.distributed.body_force[0] * volume;
      EXPECT_NEAR(normal, -weight, 1e-6 * weight);
      EXPECT_NEAR(s->states[i].rim_force.towards_ground, model.load, 1e-9 * weight);
      if (friction > 0) {
        EXPECT_NEAR(along, -model.horizontal_force - model.distributed.body_force[1] * volume, 1e-6 * weight);
        EXPECT_NEAR(s->states[i].rim_force.along_ground, model.horizontal_force, 1e-9 * weight);
      }
    }
  }
}

TEST(Loads, ShapeGradientPassesTheTaylorTest) {
  for (const double friction : {0.0, 0.3})
    for (const int which : {0, 1, 2}) {
      auto model = paper_model(14, 192);
      model.contact.friction = friction;
      if (friction > 0) model.horizontal_force = 0.1 * model.load;
      model.distributed = strong_loads();
      if (which == 0) model.distributed.hole_pressure = 0;
      if (which == 1) model.distributed.body_force = {};
      if (which == 2) model.travel = 5e-4;
      const auto problem = RollingProblem<2>::create(model);
      ASSERT_TRUE(problem);
      const auto test = generic_taylor_test(*problem, strain_energy_alone());
      ASSERT_TRUE(test) << test.failure().detail;
      for (double order : test->orders) EXPECT_GT(order, 1.9) << friction << which;
    }
}

}  // namespace
}  // namespace wheelwright
