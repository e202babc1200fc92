#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/quantities/functionals/quantities.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

using testing::generic_taylor_test;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;
using testing::strain_energy_alone;

/// Loads of the size of the wheel's own.
DistributedLoads<2> strong_loads() { return {{1e5, 3e4}, 3e4}; }

Material with_density(Material material) {
  material.density = 1200;
  return material;
}

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
  const double inner = model.grid.inner_radius, outer = model.grid.outer_radius - model.grid.row_height(0);
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

TEST(Loads, GroundCarriesTheWeight) {
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

/// A wheel of one material that rotates.
RollingModel<2> rotating_model(double angular_speed) {
  auto model = paper_model();
  model.n_positions = 1;
  model.materials = with_density(*model.materials.at_tread().isotropic());
  model.distributed.angular_speed = angular_speed;
  return model;
}

// In a solid ring that is bonded to the rim (lambda + 2 mu) (u'' + u'/r - u/r^2) = -density omega^2 r, and
// the tread, which hardly touches the ground, is free.
TEST(Loads, ARotatingRingGrowsAsThickWalledTheorySays) {
  for (const int levels : {0, 2}) {
    auto model = rotating_model(150);
    model.load = 1e-3;
    model.tread.levels = levels;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto state = testing::all_states<2>(*problem, solid(model.grid));
    ASSERT_TRUE(state) << state.failure().detail;
    const double a = model.grid.inner_radius, b = model.grid.outer_radius;
    const Material& material = *model.materials.at_tread().isotropic();
    const double lambda = material.lambda(), mu = material.mu();
    const double k = *material.density * 150 * 150 / (8 * (lambda + 2 * mu));
    // u = A r + B / r - k r^3 with u(a) = 0 and (lambda + 2 mu) u'(b) + lambda u(b) / b = 0.
    const double from_b = 2 * (lambda + mu) + 2 * mu * a * a / (b * b);
    const double A = k * (b * b * (4 * lambda + 6 * mu) + 2 * mu * std::pow(a, 4) / (b * b)) / from_b;
    const double B = k * std::pow(a, 4) - A * a * a;
    const RingField u = (*state)->displacement().at_nodes(0);
    const Lattice<2> lattice(model.grid, model.degree);
    // In the sector opposite to the ground.
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const double r = lattice.polar_point(node)[0];
      const double* at = &u.values[2 * (node + size_t(lattice.n_nodes()) * 8)];
      const double azimuth = lattice.polar_point(node)[1] + 8 * model.grid.sector_angle();
      const double radial = at[0] * std::cos(azimuth) + at[1] * std::sin(azimuth);
      const double rim = (*state)->contacts()[0].rim.towards_ground * std::cos(azimuth);
      EXPECT_NEAR(radial - rim, A * r + B / r - k * r * r * r, 1e-5 * k * b * b * b) << r;
    }
  }
}

// The rotating wheel stands on the ground before it carries anything: the travel begins there.
TEST(Loads, TravelOfARotatingWheelIsMeasuredFromItsUnloadedPlace) {
  auto model = rotating_model(150);
  model.n_positions = 4;
  const auto psi = testing::generic_hole(model.grid);
  std::vector<double> stiffness;
  for (const double load : {1e-2, 1.0, 100.0, 1e4}) {
    model.load = load;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto state = testing::all_states<2>(*problem, psi);
    ASSERT_TRUE(state) << state.failure().detail;
    for (const auto& contact : (*state)->contacts()) {
      EXPECT_GT(contact.growth, 1e-5);
      EXPECT_GT(contact.travel(), 0);
      EXPECT_LT(contact.travel(), 1e-6 + 1e-6 * load);
    }
    stiffness.push_back(shape_summary<2>(*problem, **state).stiffness);
    EXPECT_GT(stiffness.back(), 0);
  }
  // A held travel begins there too, and gives the load back that caused it.
  const auto loaded = testing::all_states<2>(*RollingProblem<2>::create(model), psi);
  const auto analysis = rolling_analysis<2>(*RollingProblem<2>::create(model), **loaded);
  ASSERT_TRUE(analysis.force_at_travel) << analysis.force_at_travel.failure().detail;
  double mean_force = 0;
  for (const double force : *analysis.force_at_travel) mean_force += force / 4;
  EXPECT_NEAR(mean_force, model.load, 0.02 * model.load);
  model.n_positions = 1;
  const auto one = testing::all_states<2>(*RollingProblem<2>::create(model), psi);
  model.travel = (*one)->contacts()[0].travel();
  const auto held = testing::all_states<2>(*RollingProblem<2>::create(model), psi);
  ASSERT_TRUE(held) << held.failure().detail;
  EXPECT_NEAR((*held)->contacts()[0].rim_force.towards_ground, 1e4, 1e-6 * 1e4);
}

TEST(Loads, TravelAndForceOfARotatingWheelPassTheTaylorTest) {
  for (const bool held : {false, true}) {
    auto model = paper_model(14, 192);
    model.n_positions = 4;
    model.distributed.angular_speed = 120;
    model.materials = with_density(*model.materials.at_tread().isotropic());
    if (held) model.travel = 4e-4;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    for (const char* quantity : {held ? "radial_force" : "travel", "stiffness"}) {
      const auto test =
          generic_taylor_test(*problem, {*functional_of<2>(built_in(quantity), Over::mean, {*problem})});
      ASSERT_TRUE(test) << test.failure().detail;
      for (double order : test->orders) EXPECT_GT(order, 1.9) << held << quantity;
    }
  }
}

// The sum of all pulls is zero unless the wheel has a single sector, whose hole is an unbalance.
TEST(Loads, AHoleIsAnUnbalance) {
  auto model = rotating_model(60);
  model.grid.cells[1] *= model.grid.n_sectors;
  model.grid.n_sectors = 1;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const double center = 0.27, radius = 0.03, azimuth = 2.1;
  const auto psi = testing::holes(model.grid, 2, {{center, azimuth, radius}});
  const auto s = problem->solve(psi);
  ASSERT_TRUE(s) << s.failure().detail;
  const double pull =
      -*model.materials.at_tread().density() * 60 * 60 * std::numbers::pi * radius * radius * center;
  const double expected = pull * std::cos(azimuth);
  EXPECT_NEAR(s->preloads[0].resultant.towards_ground, expected, 1e-4 * std::abs(pull));
}

// Under a model that differs in its loads, with the factor of another one.
TEST(Loads, StatesUnderOtherLoadsAgreeWithTheirOwnSolver) {
  auto model = paper_model(14, 192);
  model.contact.friction = 0.4;
  model.n_positions = 3;
  model.tread.observes_spin = true;
  model.materials = with_density(*model.materials.at_tread().isotropic());
  auto other = model;
  other.load = 2 * model.load;
  other.torque = 300;
  other.distributed = {{2e4, 1e4}, 1e4, 70};
  const auto problem = RollingProblem<2>::create(model), own = RollingProblem<2>::create(other);
  ASSERT_TRUE(problem && own);
  const auto psi = testing::generic_hole(model.grid);
  const auto first = testing::all_states<2>(*problem, psi), expected = testing::all_states<2>(*own, psi);
  ASSERT_TRUE(first && expected);
  const auto states = (*first)->under(other, Interrupt());
  ASSERT_TRUE(states) << states.failure().detail;
  EXPECT_EQ((*states)->model().load, other.load);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR((*states)->strain_energy()[i] / (*expected)->strain_energy()[i], 1, 1e-9);
    EXPECT_NEAR((*states)->contacts()[i].rim.rotation / (*expected)->contacts()[i].rim.rotation, 1, 1e-8);
  }
  // And back again.
  const auto back = (*states)->under(model, Interrupt());
  ASSERT_TRUE(back);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR((*back)->strain_energy()[i] / (*first)->strain_energy()[i], 1, 1e-9);
}

TEST(Loads, ShapeGradientPassesTheTaylorTest) {
  for (const double friction : {0.0, 0.3})
    for (const int which : {0, 1, 2, 3}) {
      auto model = paper_model(14, 192);
      model.contact.friction = friction;
      if (friction > 0) model.horizontal_force = 0.1 * model.load;
      model.distributed = strong_loads();
      if (which == 0) model.distributed.hole_pressure = 0;
      if (which == 1) model.distributed.body_force = {};
      if (which == 2) model.travel = 5e-4;
      if (which == 3) {
        model.distributed = {.angular_speed = 90};
        model.materials = with_density(*model.materials.at_tread().isotropic());
      }
      const auto problem = RollingProblem<2>::create(model);
      ASSERT_TRUE(problem);
      const auto test = generic_taylor_test(*problem, strain_energy_alone());
      ASSERT_TRUE(test) << test.failure().detail;
      for (double order : test->orders) EXPECT_GT(order, 1.9) << friction << which;
    }
}

}  // namespace
}  // namespace wheelwright
