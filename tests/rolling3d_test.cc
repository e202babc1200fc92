#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

RollingModel<3> small_wheel(int degree, int axial_cells) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, axial_cells}};
  model.degree = degree;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  return model;
}

const WeightedSum<3> strain_energy{{1, std::make_shared<StrainEnergy<3>>()}};

// The same program in a second instantiation: holes that vary along the axle, contact on faces.
TEST(Rolling3D, ShapeGradientPassesTheTaylorTest) {
  const auto model = small_wheel(1, 2);
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0273};
  auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    psi.values[i] += 0.002 * std::cos(20 * p[2]);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  const auto test = taylor_test<3>(
      [&](const LevelSet<3>& shape) {
        return testing::evaluate_objective<3>(*problem, strain_energy, shape);
      },
      psi, direction, model.degree, 2e-5, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  for (double order : test->orders) EXPECT_GT(order, 1.9);
}

TEST(Rolling3D, ContactCarriesTheLoadAndSectorsAgree) {
  const auto model = small_wheel(2, 1);
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem);
  const Circle hole{0.26, 0.5 * model.grid.sector_angle(), 0.03};
  const auto s = problem->solve(make_level_set<3>(Lattice<3>(model.grid, 2), std::span(&hole, 1)));
  ASSERT_TRUE(s) << s.failure().detail;
  EXPECT_TRUE(s->ring.is_mirror_symmetric());
  EXPECT_TRUE(s->ring.is_symmetric_across_width());
  for (size_t i = 0; i < s->states.size(); ++i) {
    double force = 0;
    for (size_t q = 0; q < s->states[i].traction.size(); ++q)
      force -= s->contacts[i].points()[q].weight * s->states[i].traction[q][0];
    EXPECT_NEAR(force, model.load, 1e-9 * model.load);
    EXPECT_GT(s->strain_energy[i], 0);
  }
}

/// A wheel without any symmetry: holes that change along the axle, friction, all forces on the rim, and a
/// lean.
RollingModel<3> pushed_wheel() {
  auto model = small_wheel(1, 2);
  model.contact.friction = 0.5;
  model.torque = 120;
  model.lateral_force = 350;
  model.n_positions = 2;
  return model;
}

RollingModel<3> leaning_wheel() {
  auto model = small_wheel(1, 3);
  model.contact.friction = 0.5;
  model.horizontal_force = -250;
  model.lateral_force = 400;
  model.camber = 0.004;
  return model;
}

LevelSet<3> uneven_hole(const PolarGrid<3>& grid, int degree = 1) {
  const Circle hole{0.2581, 0.47 * grid.sector_angle(), 0.0273};
  auto psi = make_level_set<3>(Lattice<3>(grid, degree), std::span(&hole, 1));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    psi.values[i] += 0.002 * std::cos(20 * psi.lattice.polar_point(i)[2]);
  return psi;
}

/// A direction with waves along all axes.
std::vector<double> uneven_direction(const Lattice<3>& lattice) {
  std::vector<double> direction;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<3> p = lattice.polar_point(i);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  return direction;
}

void expect_taylor_orders(const RollingModel<3>& model, const WeightedSum<3>& terms,
                          const RollingProblem<3>& problem) {
  const auto psi = uneven_hole(model.grid);
  const auto test = taylor_test<3>(
      [&](const LevelSet<3>& shape) { return testing::evaluate_objective<3>(problem, terms, shape); }, psi,
      uneven_direction(psi.lattice), model.degree, 2e-5, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  for (double order : test->orders) EXPECT_GT(order, 1.9);
}

TEST(Rolling3D, WithFrictionAndAllForcesTheGradientPassesTheTaylorTest) {
  for (const auto& model : {pushed_wheel(), leaning_wheel()}) {
    SCOPED_TRACE(model.camber);
    const auto problem = RollingProblem<3>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    expect_taylor_orders(model, strain_energy, *problem);
  }
}

// The hole opens in both side faces, where the edge of its wall moves too.
TEST(Rolling3D, WithAPressureInTheHolesTheGradientPassesTheTaylorTest) {
  for (const bool has_travel : {false, true}) {
    SCOPED_TRACE(has_travel);
    auto model = pushed_wheel();
    model.distributed.hole_pressure = 5e4;
    if (has_travel) model.travel = 4e-4;
    const auto problem = RollingProblem<3>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    expect_taylor_orders(model, strain_energy, *problem);
  }
}

// A hole that is a cone: its edges are circles, and its wall has one slope.
TEST(Rolling3D, EdgesInTheSideFacesAreThoseOfTheHoles) {
  constexpr double radius = 0.024, slope = 0.1;
  auto model = small_wheel(2, 2);
  model.grid.cells = {8, 6, 2};
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const double middle = 0.45 * model.grid.sector_angle();
  LevelSet<3> psi{Lattice<3>(model.grid, 2), {}};
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    const double distance =
        std::hypot(p[0] * std::cos(p[1] - middle) - 0.2581, p[0] * std::sin(p[1] - middle));
    psi.values.push_back(radius + slope * p[2] - distance);
  }
  const auto state = testing::all_states<3>(*problem, psi);
  ASSERT_TRUE(state) << state.failure().detail;
  std::array<double, 2> length{};
  for (const SurfacePoint<3>& point : (*state)->edges()) {
    const bool is_last = point.xi[2] == 1;
    EXPECT_EQ(model.grid.cell_position(point.cell)[2], is_last ? 1 : 0);
    EXPECT_NEAR(point.normal[2], slope / std::hypot(1, slope), 0.01);
    length[is_last] += point.weight;
  }
  for (const int end : {0, 1}) {
    const double expected = 2 * std::numbers::pi * (radius + end * slope * model.grid.width);
    EXPECT_NEAR(length[end] / expected, 1, 2e-3);
  }
}

TEST(Rolling3D, UniformityPassesTheTaylorTest) {
  auto model = small_wheel(1, 2);
  model.tread.annulus_points = 2;
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  expect_taylor_orders(model, {{1, std::make_shared<UniformityAnnulus<3>>(0.02)}}, *problem);
  auto map = problem->neumann_to_dirichlet(DualNorm::elasticity);
  ASSERT_TRUE(map);
  expect_taylor_orders(model, {{1, std::make_shared<UniformityDual<3>>(*std::move(map))}}, *problem);
}

// Where Coulomb's cone is round, Newton's method converges quadratically, and not in a finite number of
// steps: what is left of the residual does not depend on the start.
TEST(Rolling3D, TheContactIsSolvedToRoundingFromEveryStart) {
  auto model = pushed_wheel();  // near the limit of friction
  model.lateral_force = 0.3 * model.load;
  model.torque = 0.3 * model.load * model.grid.outer_radius;
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto s = problem->solve(uneven_hole(model.grid));
  ASSERT_TRUE(s) << s.failure().detail;
  for (size_t i = 0; i < s->states.size(); ++i) {
    const ReducedContact<3>& contact = s->contacts[i];
    const double disc = model.materials.at_tread().contact_modulus();
    for (const double factor : {0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
      const auto start =
          hertz_start(contact, factor * model.load / model.grid.width, model.grid.outer_radius, disc);
      const auto state = solve_contact<3>(contact, std::span(&start, 1));
      ASSERT_TRUE(state) << state.failure().detail;
      double difference = 0, peak = 0;
      for (size_t q = 0; q < state->traction.size(); ++q)
        for (int d = 0; d < 3; ++d) {
          difference = std::max(difference, std::abs(state->traction[q][d] - s->states[i].traction[q][d]));
          peak = std::max(peak, -state->traction[q][0]);
        }
      EXPECT_LT(difference, 1e-12 * peak) << factor;
    }
  }
}

// The ground's forces on the tread carry what acts on the rim, and nothing else.
TEST(Rolling3D, ForcesAndMomentsBalance) {
  for (const auto& model : {pushed_wheel(), leaning_wheel()}) {
    SCOPED_TRACE(model.camber);
    const auto problem = RollingProblem<3>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    const auto states = testing::all_states<3>(*problem, uneven_hole(model.grid));
    ASSERT_TRUE(states) << states.failure().detail;
    for (const ContactPatch<3>& contact : (*states)->contacts()) {
      Vec<3> force{};
      double moment = 0;
      for (const auto& point : contact.points) {
        for (int d = 0; d < 3; ++d) force[d] += point.weight * point.traction[d];
        moment +=
            point.weight * (point.traction[1] * point.position[0] - point.traction[0] * point.position[1]);
      }
      EXPECT_NEAR(force[0], -model.load, 1e-9 * model.load);
      EXPECT_NEAR(force[2], -model.lateral_force, 1e-9 * model.load);
      if (model.horizontal_force != 0) {
        EXPECT_NEAR(force[1], -model.horizontal_force, 1e-9 * model.load);
      }
      if (model.torque != 0) {
        EXPECT_NEAR(moment, -model.torque, 1e-9 * model.load);
      }
      // An upright wheel yields to the force that pushes it along the axle.
      if (model.camber == 0) {
        EXPECT_GT(contact.rim.along_axle, 0);
      }
    }
  }
}

/// The mirror image of a level set in the middle of the width.
LevelSet<3> reflected(const LevelSet<3>& psi) {
  LevelSet<3> image = psi;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    auto p = psi.lattice.node_position(i);
    p[2] = psi.lattice.nodes()[2] - 1 - p[2];
    image.values[psi.lattice.node_index(p)] = psi.values[i];
  }
  return image;
}

LevelSet<3> turned(const LevelSet<3>& psi, int columns) {
  LevelSet<3> image = psi;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    auto p = psi.lattice.node_position(i);
    p[1] += columns * psi.lattice.degree();
    image.values[psi.lattice.node_index(p)] = psi.values[i];
  }
  return image;
}

struct Seen {
  double energy, travel, sideways;
};
Seen seen(const RollingModel<3>& model, const LevelSet<3>& psi, GroundPosition ground) {
  const auto problem = RollingProblem<3>::create(model);
  ground.camber = model.camber;
  const auto states = problem->states(psi, {{ground}, {1}}, Interrupt());
  EXPECT_TRUE(states) << states.failure().detail;
  const auto& contact = (*states)->contacts()[0];
  return {(*states)->strain_energy()[0], contact.rim.towards_ground, contact.rim.along_axle};
}

void expect_same(const Seen& a, const Seen& b, double sign) {
  EXPECT_NEAR(a.energy / b.energy, 1, 1e-7);  // the cut quadrature is not mirror-symmetric to rounding
  EXPECT_NEAR(a.travel / b.travel, 1, 1e-7);
  EXPECT_NEAR(a.sideways, sign * b.sideways, 1e-7 * std::abs(b.travel));
}

TEST(Rolling3D, TheMirrorImageInTheMiddleOfTheWidthIsPushedTheOtherWay) {
  auto model = leaning_wheel();
  model.horizontal_force = 0;
  const auto psi = uneven_hole(model.grid);
  const Seen before = seen(model, psi, {0});
  model.lateral_force = -model.lateral_force;
  model.camber = -model.camber;
  expect_same(seen(model, reflected(psi), {0}), before, -1);
}

TEST(Rolling3D, AWheelTurnedByAColumnIsTheSame) {
  const auto model = leaning_wheel();
  const auto psi = uneven_hole(model.grid);
  expect_same(seen(model, turned(psi, 1), {1}), seen(model, psi, {0}), 1);
}

TEST(Rolling3D, TheLeanMovesThePressureToItsSide) {
  auto model = small_wheel(2, 2);
  model.n_positions = 1;
  const auto load_at_larger_z = [&](double camber) {
    model.camber = camber;
    const auto problem = RollingProblem<3>::create(model);
    const Circle hole{0.26, 0.5 * model.grid.sector_angle(), 0.03};
    const auto states =
        testing::all_states<3>(*problem, make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1)));
    double share = 0;
    for (const auto& point : (*states)->contacts()[0].points)
      if (point.position[2] > 0) share -= point.weight * point.traction[0] / model.load;
    return share;
  };
  const double upright = load_at_larger_z(0), leaning = load_at_larger_z(0.003);
  EXPECT_NEAR(upright, 0.5, 1e-9);
  EXPECT_GT(leaning, 0.6);
  EXPECT_NEAR(load_at_larger_z(-0.003), 1 - leaning, 0.01);
}

}  // namespace
}  // namespace wheelwright
