// A tread that is bonded to a rigid ring: exact stiffnesses of a bushing, and invariances.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::generic_hole;
using testing::paper_model;

RollingModel<2> bushing(const Material& material, int radial_cells, int angular_cells) {
  auto model = paper_model(radial_cells, angular_cells);
  model.grid.n_sectors = 8;
  model.grid.cells[1] = angular_cells / 8;
  model.materials = material;
  model.contact.counterpart = Counterpart::ring;
  model.contact_points = 3;
  model.n_positions = 1;
  return model;
}

std::shared_ptr<const State<2>> solved(const RollingModel<2>& model, const LevelSet<2>& psi) {
  const auto solver = make_solver(model);
  EXPECT_TRUE(solver);
  const auto state = (*solver)->states(psi, (*solver)->all_positions(), Interrupt());
  if (!state) throw std::runtime_error(state.failure().detail);
  return *state;
}

/// A ring of material without holes.
LevelSet<2> full(const PolarGrid<2>& grid) { return testing::holes(grid, 2, {}); }

/// Force per displacement of the inner ring [N/m per metre of width]: Kolosov's solution with the
/// displacements of both circles given (J. E. Adkins, A. N. Gent, British Journal of Applied Physics 5, 1954,
/// for nu = 1/2).
double radial_stiffness(const Material& m, double inner, double outer) {
  const double nu = m.poissons_ratio, kappa = m.plane == Plane::strain ? 3 - 4 * nu : (3 - nu) / (1 + nu);
  const double a = inner * inner, b = outer * outer, mu = m.youngs_modulus / (2 * (1 + nu));
  return 4 * pi * mu * (1 + kappa) / (kappa * std::log(b / a) - 2 / kappa * (b - a) / (b + a));
}

double torsional_stiffness(const Material& m, double inner, double outer) {
  const double mu = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
  return 4 * pi * mu / (1 / (inner * inner) - 1 / (outer * outer));
}

TEST(Bushing, RadialStiffnessConvergesToTheExactOne) {
  for (const Material& material :
       {Material{2e6, 0.3}, Material{2e6, 0.48}, Material{2e6, 0.4999}, Material{2e6, 0.3, Plane::stress}}) {
    double errors[2];
    for (const int level : {0, 1}) {
      const auto model = bushing(material, 4 << level, 64 << level);
      const double exact = radial_stiffness(material, model.grid.inner_radius, model.grid.outer_radius);
      const auto state = solved(model, full(model.grid));
      errors[level] = std::abs(model.load / state->contacts()[0].rim.towards_ground / exact - 1);
      EXPECT_NEAR(state->strain_energy()[0] / (0.5 * model.load * model.load / exact), 1, 4e-3);
    }
    EXPECT_LT(errors[1], 2e-4);
    EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
  }
}

TEST(Bushing, TorsionalStiffnessConvergesToTheExactOne) {
  double errors[2];
  for (const int level : {0, 1}) {
    auto model = bushing({2e6, 0.48}, 4 << level, 64 << level);
    model.torque = 1000;
    const double exact = torsional_stiffness({2e6, 0.48}, model.grid.inner_radius, model.grid.outer_radius);
    const auto state = solved(model, full(model.grid));
    errors[level] = std::abs(model.torque / state->contacts()[0].rim.rotation / exact - 1);
  }
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

// Linear elasticity: displacements are proportional to loads, and the ring's tractions balance them.
TEST(Bushing, WithHolesIsLinearAndBalanced) {
  auto model = bushing({2e6, 0.45}, 10, 96);
  const LevelSet<2> psi = generic_hole(model.grid);
  model.load = 1000;
  const auto pushed = solved(model, psi);
  const auto force = [](const ContactPatch<2>& contact) {
    RimForce sum_of{};
    for (const auto& p : contact.points)
      sum_of = sum(sum_of, scaled(p.weight, resultant<2>(p.traction, p.position)));
    return sum_of;
  };
  EXPECT_NEAR(force(pushed->contacts()[0]).towards_ground, -1000, 1e-6);
  model.load = 2000;
  const auto twice = solved(model, psi);
  const double travel = pushed->contacts()[0].rim.towards_ground;
  EXPECT_NEAR(twice->contacts()[0].rim.towards_ground, 2 * travel, 1e-9 * travel);
  EXPECT_NEAR(twice->strain_energy()[0], 4 * pushed->strain_energy()[0], 1e-9 * twice->strain_energy()[0]);
}

TEST(Bushing, ShapeGradientPassesTheTaylorTest) {
  auto model = bushing({2e6, 0.45}, 10, 96);
  model.n_positions = 2;
  model.torque = 50;
  for (const double theta : {-1.0, 0.0}) {
    model.contact.theta_nitsche = theta;
    model.contact.gamma_0 = theta < 0 ? 1 : 20;
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    const auto test = testing::generic_taylor_test(*problem, {{1, std::make_shared<StrainEnergy<2>>()}});
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9) << theta;
  }
}

CaseResult bushing_case(const std::string& more) {
  return parse_case(
      "[wheel]\ninner_radius = 0.01\nouter_radius = 0.03\nwidth = 0.05\nsectors = 8\n"
      "[material]\nyoungs_modulus = 2e6\n[load]\nforce = 50\n" +
          more + "[grid]\nradial_cells = 28\nangular_cells = 160\n",
      "bushing.toml");
}

TEST(Bushing, OfACaseIsSolvedOrRefusedByKey) {
  const auto good = bushing_case("torque = 1\n[contact]\nwith = \"ring\"\n");
  ASSERT_TRUE(good.value) << good.problems.front().text();
  const auto study = make_study<2>(*good.value);
  ASSERT_TRUE(study);
  EXPECT_TRUE(evaluate_of(*study)(study->initial, nullptr));
  const auto refuses = [](const std::string& more, const std::string& key) {
    const auto result = bushing_case(more);
    EXPECT_FALSE(result.value) << key;
    for (const Diagnostic& problem : result.problems) EXPECT_EQ(problem.key, key) << problem.text();
  };
  refuses("[contact]\nwith = \"ring\"\nfriction = 0.3\n", "contact.friction");
  refuses("[contact]\nwith = \"ring\"\n[objective]\nuniformity_l2 = 1\n", "objective.uniformity_l2");
  refuses("[contact]\nwith = \"ring\"\nquadrature_points = 20\n", "contact.quadrature_points");
}

}  // namespace
}  // namespace wheelwright
