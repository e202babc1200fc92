#include <gtest/gtest.h>

#include "tests/support.h"
#include "wheelwright/functionals/strain_energy.h"
#include "wheelwright/geometry/shapes.h"
#include "wheelwright/sensitivity/evaluate.h"
#include "wheelwright/sensitivity/taylor_test.h"

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
  for (size_t i = 0; i < s->states.size(); ++i) {
    double force = 0;
    for (size_t q = 0; q < s->states[i].traction.size(); ++q)
      force -= s->contacts[i].points()[q].weight * s->states[i].traction[q][0];
    EXPECT_NEAR(force, model.load, 1e-9 * model.load);
    EXPECT_GT(s->strain_energy[i], 0);
  }
}

}  // namespace
}  // namespace wheelwright
