#include "tests/large_deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "tests/support.h"
#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"
#include "wheelwright/quantities/functionals/largest_strain.h"
#include "wheelwright/quantities/functionals/material_density_integral.h"
#include "wheelwright/quantities/functionals/quantities.h"

namespace wheelwright {
namespace {

using testing::holes;

/// The paper's wheel of rubber.
RollingModel<2> soft_wheel(double modulus, double ratio = 0.3, EnergyForm form = EnergyForm::neo_hookean) {
  RollingModel<2> model = testing::paper_model(14, 192);
  model.materials = Materials<2>(std::make_shared<HyperelasticLaw<2>>(Material{modulus, ratio}, form));
  model.contact.theta_nitsche = 0;
  model.contact.gamma_0 = 20;
  model.n_positions = 2;
  return model;
}

RollingModel<2> linear(RollingModel<2> model) {
  model.materials = for_small_strains(model.materials);
  return model;
}

/// Two holes of different sizes: no symmetry.
LevelSet<2> lopsided_holes(const PolarGrid<2>& grid) {
  const double a = grid.sector_angle();
  return holes(grid, 2, {{0.2513, 0.04 * a, 0.0213}, {0.2731, 0.53 * a, 0.0267}});
}

double force(const ContactPatch<2>& patch) { return patch.rim_force.towards_ground; }

/// In the limit of small loads, with a difference of at least order 1/2 with contact. Without contact it is
/// of order 1: StoredEnergy.IsHookesLawForSmallStrains and HyperelasticElement.IsTheLinearElement...
TEST(LargeDeformation, TendsToTheLinearWheelWithTheLoad) {
  for (const double ratio : {0.3, 0.48}) {
    auto model = soft_wheel(200e6, ratio);
    model.ghost.xi = 1e-7;  // the ghost penalties of both differ
    const auto psi = lopsided_holes(model.grid);
    std::vector<double> of_travel, of_energy;
    for (const double share : {1.0, 0.25, 0.0625}) {
      auto loaded = model;
      loaded.load *= share;
      // The contact of both has the same points.
      const auto large = LargeDeformationProblem<2>::create(loaded);
      ASSERT_TRUE(large) << large.failure().detail;
      const auto small = RollingProblem<2>::create(linear(loaded));
      const auto deformed = testing::all_states(*large, psi), expected = testing::all_states(*small, psi);
      ASSERT_TRUE(deformed) << deformed.failure().detail;
      ASSERT_TRUE(expected);
      of_travel.push_back((*deformed)->contacts()[1].travel() / (*expected)->contacts()[1].travel() - 1);
      of_energy.push_back((*deformed)->strain_energy()[1] / (*expected)->strain_energy()[1] - 1);
      EXPECT_NEAR(force((*deformed)->contacts()[1]) / loaded.load, 1, 1e-9);
    }
    for (const auto& differences : {of_travel, of_energy}) {
      EXPECT_LT(std::abs(differences[0]), 0.02);
      for (int k = 0; k < 2; ++k)
        EXPECT_LT(std::abs(differences[k + 1]), 0.55 * std::abs(differences[k]) + 2e-5) << ratio;
    }
  }
}

/// A wheel of Saint Venant and Kirchhoff's material against Newton's method on another discretization, with
/// which it shares the grid, the quadrature and the shape functions alone.
TEST(LargeDeformation, IsThatOfAnIndependentWheel) {
  auto model = soft_wheel(8e6, 0.3, EnergyForm::saint_venant_kirchhoff);
  model.contact.method = ContactMethod::penalty;
  model.contact.gamma_0 = 100;
  const auto psi = lopsided_holes(model.grid);
  const testing::PlaneWheel reference(linear(model), psi);
  for (const double travel : {0.003, 0.006}) {
    model.travel = travel;
    const auto problem = LargeDeformationProblem<2>::create(model);
    const auto state = testing::all_states(*problem, psi);
    ASSERT_TRUE(state) << state.failure().detail;
    EXPECT_NEAR(force((*state)->contacts()[0]) / reference.force(testing::Theory::large_deformation, travel),
                1, 0.01);
  }
}

/// The paper's wheel in the same discrete form by GetFEM 5.4.2: bench/getfem/soft_wheel.py --moduli 32e6.
TEST(LargeDeformation, PaperWheelAgreesWithGetFem) {
  auto model = soft_wheel(32e6);
  model.ghost = {GhostPenaltyKind::paper, 1e-3};
  model.dilatation = DilatationKind::pointwise;
  const auto problem = LargeDeformationProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto state = testing::all_states(*problem, testing::paper_holes(model.grid));
  ASSERT_TRUE(state) << state.failure().detail;
  const double energies[] = {27.1898549, 41.9155376}, travels[] = {2.3275745e-3, 3.6789155e-3};
  for (int position = 0; position < 2; ++position) {
    EXPECT_NEAR((*state)->strain_energy()[position] / energies[position], 1, 1e-5);
    EXPECT_NEAR((*state)->contacts()[position].travel() / travels[position], 1, 1e-5);
  }
}

/// The force is the derivative of all energies with respect to the travel: of the material, of the ghost
/// penalty and of the contact's.
TEST(LargeDeformation, TheForceIsTheDerivativeOfTheEnergies) {
  auto model = soft_wheel(8e6, 0.48);
  model.contact.method = ContactMethod::penalty;
  const auto psi = lopsided_holes(model.grid);
  const auto at = [&](double travel) {
    model.travel = travel;
    const auto problem = LargeDeformationProblem<2>::create(model);
    const auto solution = problem->solve({psi, nullptr}, problem->all_positions());
    EXPECT_TRUE(solution) << solution.failure().detail;
    const auto& equilibrium = solution->equilibria[1];
    double energy = equilibrium.strain_energy + solution->ring->forms.forces(equilibrium.v).ghost_energy;
    const auto& points = equilibrium.contact.points();
    for (size_t i = 0; i < points.size(); ++i)
      energy += 0.5 * points[i].weight / points[i].gamma * std::pow(equilibrium.state.traction[i][0], 2);
    return std::pair(energy, equilibrium.state.rim_force.towards_ground);
  };
  constexpr double travel = 0.008, step = 2e-5;
  const auto above = at(travel + step), below = at(travel - step), middle = at(travel);
  EXPECT_NEAR((above.first - below.first) / (2 * step) / middle.second, 1, 1e-5);
}

/// The wheel turned by columns of the grid, with the ground turned back.
TEST(LargeDeformation, DoesNotChangeWithATurnByColumns) {
  auto model = soft_wheel(8e6, 0.48);
  model.contact.friction = 0.3;
  const auto psi = lopsided_holes(model.grid);
  const int columns = 3, per_line = psi.lattice.nodes_per_line();
  LevelSet<2> turned = psi;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    turned.values[(i + 2 * columns * per_line) % psi.lattice.n_nodes()] = psi.values[i];
  const auto problem = LargeDeformationProblem<2>::create(model);
  const auto first = problem->states({psi, nullptr}, {{{1}}, {1}}, Interrupt()),
             second = problem->states({turned, nullptr}, {{{1 + columns}}, {1}}, Interrupt());
  ASSERT_TRUE(first && second);
  EXPECT_NEAR((*second)->strain_energy()[0] / (*first)->strain_energy()[0], 1, 1e-9);
  EXPECT_NEAR((*second)->contacts()[0].travel() / (*first)->contacts()[0].travel(), 1, 1e-9);
  const auto &a = (*first)->contacts()[0].points, &b = (*second)->contacts()[0].points;
  ASSERT_EQ(a.size(), b.size());
  double largest = 0;
  for (const auto& point : a) largest = std::max(largest, norm(point.traction));
  for (size_t i = 0; i < a.size(); ++i)
    for (int d = 0; d < 2; ++d) EXPECT_NEAR(a[i].traction[d], b[i].traction[d], 1e-8 * largest);
}

/// A load and the travel that it leads to are the same solution, from any start.
TEST(LargeDeformation, LoadAndTravelLeadToTheSameSolution) {
  auto model = soft_wheel(8e6);
  const auto psi = lopsided_holes(model.grid);
  const auto by_load = LargeDeformationProblem<2>::create(model);
  const auto loaded = by_load->solve({psi, nullptr}, by_load->all_positions());
  ASSERT_TRUE(loaded) << loaded.failure().detail;
  model.travel = loaded->equilibria[0].state.rim.towards_ground;
  const auto by_travel = LargeDeformationProblem<2>::create(model);
  for (const auto& starts : {StartDisplacements{}, starts_from(*loaded)}) {
    const auto moved = by_travel->solve({psi, nullptr}, by_travel->all_positions(), starts);
    ASSERT_TRUE(moved);
    EXPECT_NEAR(moved->equilibria[0].state.rim_force.towards_ground / model.load, 1, 1e-8);
    EXPECT_NEAR(moved->equilibria[0].strain_energy / loaded->equilibria[0].strain_energy, 1, 1e-8);
  }
}

/// From the displacements of a similar shape, with material where that has holes: the same solution with
/// fewer tangents.
TEST(LargeDeformation, FindsTheSameSolutionFromThatOfASimilarShape) {
  const auto model = soft_wheel(8e6);
  const double angle = model.grid.sector_angle();
  const auto before = lopsided_holes(model.grid);
  const auto psi = holes(model.grid, 2, {{0.2507, 0.05 * angle, 0.0205}, {0.2735, 0.53 * angle, 0.0262}});
  const auto problem = LargeDeformationProblem<2>::create(model);
  const auto known = problem->solve({before, nullptr}, problem->all_positions());
  ASSERT_TRUE(known) << known.failure().detail;
  const auto near = problem->solve({psi, nullptr}, problem->all_positions(), starts_from(*known));
  const auto from_rest = problem->solve({psi, nullptr}, problem->all_positions());
  ASSERT_TRUE(near) << near.failure().detail;
  ASSERT_TRUE(from_rest) << from_rest.failure().detail;
  for (size_t i = 0; i < near->equilibria.size(); ++i) {
    const auto &a = near->equilibria[i], &b = from_rest->equilibria[i];
    EXPECT_NEAR(a.strain_energy / b.strain_energy, 1, 1e-8);
    EXPECT_NEAR(a.state.rim.towards_ground / b.state.rim.towards_ground, 1, 1e-8);
    EXPECT_LE(2 * a.n_tangents, b.n_tangents);
  }

  // A start belongs to its position, whatever its place among them, and one of another grid is left unused.
  auto others = starts_from(*known);
  std::swap(others[0], others[1]);
  const auto again = problem->solve({psi, nullptr}, problem->all_positions(), others);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->equilibria[0].strain_energy, near->equilibria[0].strain_energy);
  for (auto& start : others) start.displacement.values.resize(2);
  const auto without = problem->solve({psi, nullptr}, problem->all_positions(), others);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->equilibria[0].strain_energy, from_rest->equilibria[0].strain_energy);
}

/// The points of the contact are where the loaded tread is: those that touch lie on the ground, up to the
/// penetration of Nitsche's method, and their areas are the length of the loaded tread.
TEST(LargeDeformation, ContactPointsAreThoseOfTheLoadedWheel) {
  auto model = soft_wheel(8e6);
  model.travel = 0.012;
  const auto problem = LargeDeformationProblem<2>::create(model);
  const auto solved = testing::all_states(*problem, lopsided_holes(model.grid));
  ASSERT_TRUE(solved) << solved.failure().detail;
  const Lattice<2> lattice(model.grid, model.degree);
  for (int position = 0; position < (*solved)->positions().size(); ++position) {
    const auto& patch = (*solved)->contacts()[position];
    std::map<int, double> lengths;
    double moved = 0, of_edges = 0;
    for (const auto& point : patch.points) {
      lengths[point.column] += point.area();
      moved = std::max(moved, std::abs(point.moved[1]));
      of_edges = std::max(of_edges, std::abs(point.stretch - 1));
      EXPECT_NEAR(point.area() * point.pressure(), -point.weight * point.traction[0], 1e-9 * model.load);
      if (point.augmented[0] >= -1e4) continue;
      EXPECT_NEAR(point.place()[0] + patch.rim.towards_ground, model.grid.outer_radius, 2e-4);
    }
    EXPECT_GT(moved, 1e-3);
    EXPECT_GT(of_edges, 0.01);

    const RingField field = (*solved)->displacement().at_nodes(position);
    const auto at = [&](int line) {
      const std::size_t node = ring_node<2>(lattice, {lattice.nodes()[0] - 1, line});
      const Vec<2> u{field.values[2 * node], field.values[2 * node + 1]};
      return rotated<2>({model.grid.outer_radius}, line * lattice.node_angle()) + u;
    };
    for (const auto& [column, length] : lengths) {
      const Vec<2> a = at(2 * column), b = at(2 * column + 1), c = at(2 * column + 2);
      double of_nodes = 0;  // of the parabola through them
      constexpr int parts = 1000;
      for (int k = 0; k < parts; ++k) {
        const double t = 2 * (k + 0.5) / parts - 1;
        of_nodes += norm((t - 0.5) * a - 2 * t * b + (t + 0.5) * c) * 2 / parts;
      }
      EXPECT_NEAR(length / of_nodes, 1, 1e-6);
    }
  }
}

/// Powers of the von Mises stress, which depend on the strain everywhere.
class StressPower : public MaterialDensityIntegral<2> {
 public:
  std::string name() const override { return "stress_power"; }

 private:
  Value at(const Voigt<2>& strain, const MaterialLaw<2>& law) const override {
    double square;
    Voigt<2> slope;
    law.squared_von_mises(one_strain<2>(strain), {&square, 1});
    law.squared_von_mises_slope(one_strain<2>(strain), one_stress<2>(slope));
    constexpr double scale = 1e-12;  // of 1 MPa
    for (double& x : slope) x *= 2 * scale * scale * square;
    return {scale * scale * square * square, slope};
  }
};

/// The Taylor tests of functions of a model: of energy, stresses and what the rim does.
void expect_second_order(const RollingModel<2>& model) {
  const auto problem = LargeDeformationProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const PeakNorm peak{.exponent = 8, .correction = 1};  // held, as it is within a shape
  std::vector<ShapeFunction<2>> functions{{"energy", {{1, std::make_shared<StrainEnergy<2>>()}}},
                                          {"stress", {{1, std::make_shared<StressPower>()}}},
                                          {"strain", {{1, std::make_shared<LargestStrain<2>>(peak)}}}};
  const char* of_rim = model.travel ? "radial_force" : "travel";
  functions.push_back({of_rim, {*functional_of<2>(built_in(of_rim), Over::mean, {*problem})}});
  const auto psi = testing::generic_hole(model.grid);
  const auto evaluated = [&](const LevelSet<2>& shape) -> Expected<Evaluation<2>> {
    auto result = evaluate<2>(*problem, functions, shape);
    if (!result) return result.failure();
    return std::move(result->evaluation);
  };
  const auto start = evaluated(psi);
  ASSERT_TRUE(start) << start.failure().detail;
  const auto tests =
      taylor_tests<2>(evaluated, *start, psi, testing::smooth_direction(psi.lattice), model.degree, 4e-5, 2);
  ASSERT_TRUE(tests) << tests.failure().detail;
  for (size_t f = 0; f < functions.size(); ++f) {
    const TaylorTest& test = (*tests)[f];
    for (size_t k = 0; k < test.orders.size(); ++k) {
      const double predicted = std::abs(test.derivative * test.steps[k + 1]);
      if (test.remainders[k + 1] < 1e-5 * predicted) continue;  // almost linear
      EXPECT_GT(test.orders[k], 1.9) << functions[f].name << " = " << test.value << ", "
                                     << test.remainders[k + 1] / predicted;
    }
  }
}

TEST(LargeDeformation, ShapeGradientsPassTheTaylorTestAtLargeTravels) {
  const double thickness = 0.14;
  for (const double ratio : {0.3, 0.48})
    for (const double travel : {0.02 * thickness, 0.1 * thickness}) {
      auto model = soft_wheel(8e6, ratio);
      model.n_positions = 1;
      model.cut_points = 6;
      model.contact.friction = 0.4;
      model.travel = travel;
      expect_second_order(model);
    }
}

TEST(LargeDeformation, ShapeGradientsPassTheTaylorTestUnderALoad) {
  auto model = soft_wheel(8e6);
  model.cut_points = 6;
  model.contact.friction = 0.4;
  expect_second_order(model);
}

/// Straight spokes on the azimuths between sectors.
LevelSet<2> spokes(const PolarGrid<2>& grid, double width) {
  LevelSet<2> psi{Lattice<2>(grid, 2), {}};
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> p = psi.lattice.polar_point(i);
    const double azimuth = p[1] - grid.sector_angle() * std::round(p[1] / grid.sector_angle());
    psi.values.push_back(
        std::min({p[0] - 0.2213, 0.3087 - p[0], p[0] * std::abs(azimuth) - width / 2 - 0.00037}));
  }
  return psi;
}

/// A straight spoke above the ground stays straight in Newton's method, but buckles to a side.
TEST(LargeDeformation, BucklingOfASymmetricWheelIsNamed) {
  auto model = soft_wheel(8e6);
  model.grid = {0.20, 0.34, 0.12, 16, {10, 14}};
  const auto psi = spokes(model.grid, 0.008);
  const auto at = [&](double travel) {
    model.travel = travel;
    return LargeDeformationProblem<2>::create(model)->solve({psi, nullptr}, {{{0}}, {1}});
  };
  const auto straight = at(0.001);
  ASSERT_TRUE(straight) << straight.failure().detail;
  const auto buckled = at(0.006);
  ASSERT_FALSE(buckled);
  EXPECT_EQ(buckled.failure().reason, FailureReason::not_positive_definite) << buckled.failure().detail;
  ASSERT_TRUE(buckled.failure().instability);
  const auto& [eigenvalue, mode] = *buckled.failure().instability;
  EXPECT_LT(eigenvalue, 0);
  // The mode changes its sign in the mirror.
  const RingSpace<2>& space = straight->ring->forms.space();
  for (int node = 0; node < space.n_nodes(); ++node) {
    auto p = space.position_in_sector(node);
    p[1] += node / space.n_nodes_of_sector() * space.lattice().nodes()[1];
    const int image = space.number({p[0], -p[1]});
    EXPECT_NEAR(mode[2 * node], -mode[2 * image], 1e-5);
    EXPECT_NEAR(mode[2 * node + 1], mode[2 * image + 1], 1e-5);
  }
}

TEST(LargeDeformation, RefusesWhatItDoesNotKnow) {
  const auto model = soft_wheel(8e6);
  const auto is_refused = [](const RollingModel<2>& refused) {
    const auto problem = LargeDeformationProblem<2>::create(refused);
    return !problem && problem.failure().reason == FailureReason::unsupported_model;
  };
  EXPECT_FALSE(is_refused(model));
  auto other = model;
  other.torque = 10;
  EXPECT_TRUE(is_refused(other));
  other = model;
  other.contact.theta_nitsche = -1;
  EXPECT_TRUE(is_refused(other));
  other = model;
  other.tread.levels = 1;
  EXPECT_TRUE(is_refused(other));
  other = model;
  other.distributed.hole_pressure = 1e4;
  EXPECT_TRUE(is_refused(other));
  other = model;
  other.ground = Ground::drum(1);
  EXPECT_TRUE(is_refused(other));
}

}  // namespace
}  // namespace wheelwright
