// How warm rolling wheels get: derivatives, balances, invariances, keys.

#include "wheelwright/quantities/functionals/peak_temperature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/read.h"
#include "wheelwright/mechanics/heat/heat_source.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/quantities/analysis/heat_results.h"
#include "wheelwright/quantities/analysis/rolling_losses.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using testing::generic_hole;
using testing::paper_model;

constexpr double speed = 5;  // [m/s]

/// A polymer.
Material warm(double loss_factor, double conductivity, Plane plane = Plane::strain) {
  Material material{200e6, 0.35, plane};
  material.density = 1200;
  material.loss_factor = loss_factor;
  material.conductivity = conductivity;
  return material;
}

/// Driven, with friction and loads on the structure: without any symmetry.
RollingModel<2> lopsided_model(const Materials<2>& materials, const Cooling& cooling) {
  auto model = paper_model(14, 192);
  model.materials = materials;
  model.n_positions = 4;
  model.cut_points = 8;  // the derivative of an integral over cut cells is exact up to their quadrature
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed = {{3e4, 1e4}, 1e4, speed / model.grid.outer_radius};
  model.cooling = cooling;
  return model;
}

template <int dim>
TaylorTest tested(const StateSolver<dim>& solver, const WeightedSum<dim>& terms, const LevelSet<dim>& psi,
                  std::span<const double> direction) {
  const auto test = taylor_test<dim>(
      [&](const LevelSet<dim>& shape) { return testing::evaluate_objective<dim>(solver, terms, shape); }, psi,
      direction, solver.model().degree, 2e-5, 3);
  if (!test) throw std::runtime_error(test.failure().detail);
  return *test;
}

/// With the correction of the norm held, of which it is the derivative.
template <int dim>
TaylorTest tested(const RollingModel<dim>& model, const LevelSet<dim>& psi, std::span<const double> direction,
                  const std::optional<PartOfRing>& part = {}) {
  const auto problem = RollingProblem<dim>::create(model);
  if (!problem) throw std::runtime_error(problem.failure().detail);
  const WeightedSum<dim> norm{{1, std::make_shared<PeakTemperature<dim>>(part, PeakNorm{4, 1.0})}};
  return tested<dim>(*problem, norm, psi, direction);
}

TaylorTest tested(const RollingModel<2>& model, const std::optional<PartOfRing>& part = {}) {
  const auto psi = generic_hole(model.grid);
  return tested<2>(model, psi, testing::smooth_direction(psi.lattice), part);
}

void expect_exact(const TaylorTest& test) {
  EXPECT_NE(test.derivative, 0);
  for (const double order : test.orders) EXPECT_GT(order, 1.9);
}

// The rim colder than the air, warmer, and insulated.
TEST(PeakTemperature, PassesTheTaylorTest) {
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (const Cooling& cooling :
         {Cooling{20, 5, 25, 0, 10}, Cooling{20, 35, 25, 0, 0}, Cooling{20, {}, 25, 0, 10}})
      expect_exact(tested(lopsided_model(warm(0.1, 0.3, plane), cooling)));
}

/// The heat leaves through edges whose length, curvature and kinks change.
TEST(PeakTemperature, WithConvectionInTheHolesPassesTheTaylorTest) {
  expect_exact(tested(lopsided_model(warm(0.1, 0.3), Cooling{20, 35, 25, 25, 10})));
}

/// A layer without losses, and a part of the ring.
TEST(PeakTemperature, OfLayersPassesTheTaylorTest) {
  const auto law = [](double loss_factor, double conductivity) {
    return std::make_shared<const IsotropicLaw<2>>(warm(loss_factor, conductivity));
  };
  const auto model = lopsided_model(
      Materials<2>(
          {{0.25, law(0.05, 0.2), "inside"}, {0.29, law(0, 5), "band"}, {0.34, law(0.2, 0.3), "tread"}}),
      Cooling{20, 35, 25, 0, 10});
  expect_exact(tested(model));
  expect_exact(tested(model, PartOfRing{"band", 0.25, 0.29}));
}

/// Each load case warms the wheel by its own speed.
TEST(PeakTemperature, OfTwoLoadCasesPassesTheTaylorTest) {
  const auto model = lopsided_model(warm(0.1, 0.3), Cooling{20, 35, 25, 0, 10});
  auto slow = model;
  slow.load *= 1.4;
  slow.distributed.angular_speed *= 0.6;
  const LoadCases<2> cases{{"fast", model}, {"slow", slow}};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto temperature = std::make_shared<PeakTemperature<2>>(std::nullopt, PeakNorm{4, 1.0});
  const ShapeFunction<2> function = objective<2>({{1, temperature, 0}, {0.5, temperature, 1}});
  const auto psi = generic_hole(model.grid);
  const auto test = taylor_test<2>(
      [&](const LevelSet<2>& shape) -> Expected<Evaluation<2>> {
        auto evaluated = evaluate<2>(*problem, std::span(&function, 1), shape, nullptr, {}, cases);
        if (!evaluated) return evaluated.failure();
        return std::move(evaluated->evaluation);
      },
      psi, testing::smooth_direction(psi.lattice), 2, 2e-5, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  expect_exact(*test);
}

RollingModel<3> solid_model(int axial_cells, const Cooling& cooling) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, axial_cells}};
  model.degree = 1;
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  model.materials = warm(0.1, 0.3);
  model.distributed.angular_speed = speed / model.grid.outer_radius;
  model.cooling = cooling;
  return model;
}

LevelSet<3> lopsided_shape(const PolarGrid<3>& grid, int degree) {
  const Circle hole{0.2581, 0.47 * grid.sector_angle(), 0.0273};
  auto psi = make_level_set<3>(Lattice<3>(grid, degree), std::span(&hole, 1));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    psi.values[i] += 0.002 * std::cos(20 * psi.lattice.polar_point(i)[2]);
  return psi;
}

TaylorTest tested_in_3d(const RollingModel<3>& model, int level_set_degree) {
  const auto psi = lopsided_shape(model.grid, level_set_degree);
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  return tested<3>(model, psi, direction);
}

TEST(PeakTemperature, PassesTheTaylorTestIn3D) {
  for (const Cooling& cooling :
       {Cooling{20, 35, 25, 0, 0}, Cooling{20, 35, 25, 0, 30}, Cooling{20, 35, 25, 20, 30}}) {
    auto model = solid_model(2, cooling);
    model.contact.friction = 0.5;
    model.torque = 120;
    model.lateral_force = 350;
    expect_exact(tested_in_3d(model, 1));
  }
}

// A level set of degree 2 has more kinks than points of the usual quadrature in a cell. Strong convection in
// the holes shows them.
TEST(PeakTemperature, OfACaseInThreeDimensionsPassesTheTaylorTest) {
  const auto read = parse_case(R"([wheel]
dimension = 3
[material]
youngs_modulus = 200e6
poissons_ratio = 0.35
density = 1200
loss_factor = 0.1
conductivity = 0.3
[contact]
friction = 0.5
quadrature_points = 3
[load]
force = 2943
torque = 120
lateral_force = 350
speed = 5
positions = 2
[heat]
rim_temperature = 35
tread_convection = 25
convection = 200
[[holes.ring]]
count = 16
center_radius = 0.26
radius = 0.03
[grid]
radial_cells = 7
angular_cells = 96
axial_cells = 2
degree = 1
tread_levels = 0
[objective]
minimize = "peak_temperature"
[optimizer]
rim_band = 0.021
tread_band = 0.041
)",
                               "case.toml");
  ASSERT_TRUE(read.value) << read.problems.front().text();
  expect_exact(tested_in_3d(rolling_model<3>(*read.value), 2));
}

template <int dim>
HeatResults results(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                    const LoadPositions& positions) {
  const auto state = solver.states(psi, positions, Interrupt());
  if (!state) throw std::runtime_error(state.failure().detail);
  const auto found = heat_results<dim>(solver, psi, **state);
  if (!found || !*found) throw std::runtime_error("there are no temperatures");
  return **found;
}

/// What the rim, the tread, the holes and the side faces take is the heat.
void expect_balance(const HeatResults& r) {
  EXPECT_GT(r.heat, 0);
  for (const double power : {r.through_tread, r.through_holes, r.through_side_faces}) EXPECT_GT(power, 0);
  EXPECT_NE(r.through_rim, 0);
  EXPECT_NEAR((r.through_rim + r.through_tread + r.through_holes + r.through_side_faces) / r.heat, 1, 1e-9);
}

TEST(PeakTemperature, HeatIsBalanced) {
  const Cooling cooling{20, 35, 25, 15, 10};
  const auto model = lopsided_model(warm(0.1, 0.3), cooling);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  expect_balance(results<2>(*problem, generic_hole(model.grid), problem->all_positions()));
  const auto solid = solid_model(2, cooling);
  const auto in_3d = RollingProblem<3>::create(solid);
  ASSERT_TRUE(in_3d);
  expect_balance(results<3>(*in_3d, lopsided_shape(solid.grid, 1), in_3d->all_positions()));
}

/// Of a wheel whose energies are integrals of its strains.
TEST(PeakTemperature, HeatIsResistanceTimesSpeed) {
  auto model = lopsided_model(warm(0.1, 0.3), Cooling{20, 35, 25, 15, 10});
  model.dilatation = DilatationKind::pointwise;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = generic_hole(model.grid);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  const auto losses = rolling_losses<2>(*problem, psi, **state);
  const double power = (*losses)->resistance * speed;
  EXPECT_NEAR(results<2>(*problem, psi, problem->all_positions()).heat / power, 1, 1e-6);
}

// Twice the loss factor heats the wheel twice as much over the air.
TEST(PeakTemperature, RisesWithTheLosses) {
  const auto rise = [](double loss_factor, double ambient) {
    const auto model = lopsided_model(warm(loss_factor, 0.3), Cooling{ambient, {}, 25, 15, 10});
    const auto problem = RollingProblem<2>::create(model);
    return results<2>(*problem, generic_hole(model.grid), problem->all_positions()).peak.temperature -
           ambient;
  };
  const double once = rise(0.05, 20);
  EXPECT_NEAR(rise(0.1, 20) / once, 2, 1e-9);
  EXPECT_NEAR(rise(0.05, 55) / once, 1, 1e-9);
}

/// The quantity and the results give the same number, also on half of the width.
TEST(PeakTemperature, OfHalfOfTheWidthIsThatOfTheWhole) {
  const auto model = solid_model(4, Cooling{20, 15, 25, 15, 10});
  const auto whole = RollingProblem<3>::create(model);
  const auto half = HalfWidthSolver::create(model);
  ASSERT_TRUE(whole && half);
  const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0273};
  const auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  const double of_whole = results<3>(*whole, psi, whole->all_positions()).peak.temperature;
  EXPECT_NEAR(results<3>(**half, psi, (*half)->all_positions()).peak.temperature, of_whole, 1e-6);
  const WeightedSum<3> terms{{1, std::make_shared<PeakTemperature<3>>()}};
  const auto by_half = testing::evaluate_objective<3>(**half, terms, psi),
             by_whole = testing::evaluate_objective<3>(*whole, terms, psi);
  ASSERT_TRUE(by_half && by_whole);
  EXPECT_NEAR(by_whole->functions[0].value, of_whole, 1e-9 * of_whole);
  EXPECT_NEAR(by_half->functions[0].value, of_whole, 1e-6);
  const std::vector<double> everywhere(psi.lattice.n_nodes(), 1.0);
  const auto derivative = [&](const Evaluation<3>& e) {
    return directional_derivative<3>(e.gradient("objective"), psi, everywhere, 1) +
           directional_derivative<3>(e.edge_gradient("objective"), psi, everywhere, 1);
  };
  EXPECT_NEAR(derivative(*by_half) / derivative(*by_whole), 1, 1e-6);
}

/// Which no shape changes.
TEST(PeakTemperature, IsThatOfTheRimWhereThatIsWarmest) {
  const auto model = solid_model(2, Cooling{20, 35, 25, 15, 10});
  const auto problem = RollingProblem<3>::create(model);
  ASSERT_TRUE(problem);
  const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0273};
  const auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  const auto found = results<3>(*problem, psi, problem->all_positions());
  EXPECT_EQ(found.peak.temperature, 35);
  EXPECT_EQ(found.peak.place[0], model.grid.inner_radius);
  const auto evaluated = testing::evaluate_objective<3>(
      *problem, WeightedSum<3>{{1, std::make_shared<PeakTemperature<3>>()}}, psi);
  ASSERT_TRUE(evaluated);
  EXPECT_EQ(evaluated->functions[0].value, 35);
}

/// The wheel that begins at another column, and its mirror image, get as warm.
TEST(PeakTemperature, IsThatOfAnyOtherSectorAndOfTheImage) {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  model.materials = warm(0.1, 0.3);
  model.distributed.angular_speed = speed / model.grid.outer_radius;
  model.cooling = Cooling{20, 35, 25, 15, 10};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const double a = model.grid.sector_angle(), column = a / model.grid.cells[1];
  const auto turned = [&](double by, double sign) {
    const auto psi = testing::holes(
        model.grid, 2, {{0.2513, sign * 0.04 * a + by, 0.0213}, {0.2731, sign * 0.53 * a + by, 0.0267}});
    return results<2>(*problem, psi, problem->all_positions()).peak.temperature;
  };
  const double here = turned(0, 1);
  EXPECT_NEAR(turned(3 * column, 1), here, 1e-9 * here);
  EXPECT_NEAR(turned(a, -1), here, 1e-9 * here);
}

// Positions of a symmetric wheel that stand for their images do not suffice. The wheel's hottest place lies
// in the tread between two holes or over one, where its image is itself.
TEST(PeakTemperature, OfASymmetricWheelIsSymmetric) {
  auto model = paper_model(14, 192);
  model.n_positions = 4;
  model.materials = warm(0.1, 0.3);
  model.distributed.angular_speed = speed / model.grid.outer_radius;
  model.cooling = Cooling{20, 20, 25, 15, 10};
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  const auto distinct = problem->distinct_positions(psi);
  ASSERT_TRUE(distinct.stand_for_images());
  const auto half = results<2>(*problem, psi, distinct),
             all = results<2>(*problem, psi, problem->all_positions());
  EXPECT_NEAR(half.peak.temperature, all.peak.temperature, 1e-9 * all.peak.temperature);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  const auto steady = steady_temperature<2>(*problem, **state);
  ASSERT_TRUE(steady);
  const Lattice<2>& lattice = steady->rise.lattice;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.node_position(node);
    EXPECT_NEAR(steady->rise.values[node], steady->rise.values[lattice.node_index({p[0], -p[1]})], 1e-8);
  }
}

TEST(PeakTemperature, KeysMustSayWhatTakesTheHeat) {
  const auto problems = [](const std::string& heat, const std::string& material, const std::string& load) {
    return parse_case("[material]\ndensity = 1200\n" + material + "[load]\nforce = 2000\n" + load + heat,
                      "case.toml")
        .problems.size();
  };
  const std::string heat = "[heat]\nconvection = 20\n", known = "loss_factor = 0.1\nconductivity = 0.3\n",
                    rolling = "speed = 2\n";
  EXPECT_EQ(problems(heat, known, rolling), 0);
  EXPECT_EQ(problems("[heat]\nrim_temperature = 30\n", known, rolling), 0);
  EXPECT_EQ(problems("[heat]\nambient_temperature = 30\n", known, rolling), 1);
  EXPECT_EQ(problems(heat, "loss_factor = 0.1\n", rolling), 1);
  EXPECT_EQ(problems(heat, "conductivity = 0.3\n", rolling), 1);
  EXPECT_EQ(problems(heat, known, ""), 1);
  EXPECT_EQ(problems("[objective]\nminimize = \"peak_temperature\"\n[[holes.ring]]\ncount = 16\n"
                     "center_radius = 0.26\nradius = 0.03\n",
                     known, rolling),
            1);
}

// The air does not reach a tread that is bonded to a ring.
TEST(PeakTemperature, OfABushingHasNoConvectionAtItsTread) {
  Case c;
  c.heat.convection = 20;
  EXPECT_EQ(cooling(c)->tread, 20);
  c.contact.with = Counterpart::ring;
  EXPECT_EQ(cooling(c)->tread, 0);
  EXPECT_EQ(cooling(c)->holes, 20);
  c.heat.tread_convection = 500;
  EXPECT_EQ(cooling(c)->tread, 500);
}

}  // namespace
}  // namespace wheelwright
