#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/rolling_ring.h"
#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/quantities/analysis/ground_pass.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::generic_hole;
using testing::generic_taylor_test;
using testing::paper_model;
using testing::strain_energy_alone;

const Ground drum = Ground::drum(0.5), internal_drum = Ground::internal_drum(0.8),
             bar = Ground::bar(0.01, 0.02, 0.02), kerb = Ground::kerb(0.02, 0.02, 0.01);

const std::vector<std::pair<std::string, Ground>> grounds{
    {"drum", drum}, {"internal drum", internal_drum}, {"bar", bar}, {"kerb", kerb}};

/// A wheel that is no mirror image of itself.
RollingModel<2> lopsided_model(const Ground& ground, double friction = 0) {
  RollingModel<2> model = paper_model(14, 192);
  model.tread.levels = 2;
  model.contact.friction = friction;
  model.ground = ground;
  return model;
}

Expected<RollingSolution<2>> solved(const RollingModel<2>& model) {
  return RollingProblem<2>::create(model)->solve(generic_hole(model.grid));
}

/// The largest relative difference of energies and travels.
double difference(const RollingSolution<2>& a, const RollingSolution<2>& b) {
  double largest = 0;
  for (size_t i = 0; i < b.states.size(); ++i) {
    largest = std::max(largest, std::abs(a.strain_energy[i] / b.strain_energy[i] - 1));
    largest =
        std::max(largest, std::abs(a.states[i].rim.towards_ground / b.states[i].rim.towards_ground - 1));
  }
  return largest;
}

struct HertzContact {
  double peak_pressure, half_width, approach;
};

/// A solid disc between two equal grounds, as in hertz_test.cc.
HertzContact squeeze_disc(const Ground& ground, double load, const Material& material, double half_width) {
  const PolarGrid<2> grid{0.001, 0.34, 0.12, 2, {56, 168}};
  const TreadGrid refinement{4, 4, 0};
  const ElementTable<2> table(grid, 2, material, {});
  const auto tread = Tread<2>::condense(table, refinement, {}, 5);
  const SectorHarmonics half_turn(1);
  const CutDomain<2> full{grid, std::vector<CellKind>(grid.n_cells(), CellKind::inside), {}, {}};
  const auto ring = CyclicStiffness<2>::factor(
      sector_stiffness<2>(full, table, 56 - refinement.rows),
      [&](int harmonic) { return tread->outer_stiffness(half_turn, harmonic); }, half_turn);
  const auto contact =
      reduced_contact<2>({*ring, *tread, 3}, *tread, grid, {0}, {-2, 4}, std::make_shared<CoulombLaw<2>>(0),
                         {{}, {{{.towards_ground = 1}, load}}}, {}, ground);
  const ContactUnknowns<2> guess =
      hertz_start(contact, load, effective_radius(ground, 0.34), material.contact_modulus());
  const auto state = solve_contact<2>(contact, std::span(&guess, 1));
  EXPECT_TRUE(state);
  // p^2 = p0^2 (1 - x^2 / a^2): a straight line in x^2.
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < contact.n_points(); ++i) {
    const double x = std::pow(contact.points()[i].position[1], 2), y = std::pow(state->traction[i][0], 2);
    if (std::abs(contact.points()[i].position[1]) > 0.9 * half_width) continue;
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), start = (sy - slope * sx) / n;
  return {std::sqrt(start), std::sqrt(-start / slope), state->rim.towards_ground};
}

// 1/R = 1/R_1 + 1/R_2, negative inside a drum, with 36 cells or so in the contact.
TEST(RollingGround, ADiscBetweenTwoDrumsIsHertzs) {
  const Material material{200e6, 0.48};
  const double modulus = material.contact_modulus(), width = 7.2e-3;
  for (const auto& ground : {Ground::drum(0.34), Ground::drum(1), Ground::internal_drum(1)}) {
    const double radius = effective_radius(ground, 0.34);
    const double load = width * width * pi * modulus / (4 * radius), p0 = 2 * load / (pi * width);
    const double approach = load / (pi * modulus) * (2 * std::log(4 * 0.34 / width) - 1);  // Johnson, (5.57)
    const auto disc = squeeze_disc(ground, load, material, width);
    EXPECT_NEAR(disc.peak_pressure, p0, 5e-3 * p0) << radius;
    EXPECT_NEAR(disc.half_width, width, 5e-3 * width) << radius;
    EXPECT_NEAR(disc.approach, approach, 2e-3 * approach) << radius;
  }
}

// A ring that fits closely into a drum, and one on a drum, against the exact solution.
TEST(RollingGround, ARingOnAndInADrumIsThatOfTheSeries) {
  const Material material{200e6, 0.3};
  RollingModel<2> model = paper_model(28, 384);
  model.materials = material;
  model.n_positions = 1;
  for (const auto& [radius, half_angle, levels] :
       {std::tuple{-0.36, 0.3, 1}, {-0.4, 0.1, 3}, {0.5, 0.03, 4}}) {
    const auto exact = testing::RollingRingSeries(0.20, 0.34, material, 1 / radius).at(half_angle);
    model.ground = radius < 0 ? Ground::internal_drum(-radius) : Ground::drum(radius);
    model.load = exact.load;
    model.tread.levels = levels;
    const auto s = RollingProblem<2>::create(model)->solve(testing::holes(model.grid, 2, {}));
    ASSERT_TRUE(s) << radius << ": " << s.failure().detail;
    double peak = 0;
    for (const auto& traction : s->states[0].traction) peak = std::max(peak, -traction[0]);
    EXPECT_NEAR(s->states[0].rim.towards_ground / exact.travel, 1, 1e-4) << radius;
    EXPECT_NEAR(s->strain_energy[0] / exact.strain_energy, 1, 2e-4) << radius;
    EXPECT_NEAR(peak / exact.peak_pressure, 1, 1e-3) << radius;
  }
}

// Forces and moments of the ground are those of the loads; the pressure of tilted normals included.
TEST(RollingGround, ForcesAndMomentsBalance) {
  for (const auto& [name, ground] : grounds)
    for (const double friction : {0.0, 0.3})
      for (const double force : {0.0, 0.1}) {
        if (force != 0 && friction == 0) continue;
        auto model = lopsided_model(ground, friction);
        model.horizontal_force = force * model.load;
        const auto s = solved(model);
        ASSERT_TRUE(s) << name << ": " << s.failure().detail;
        for (size_t i = 0; i < s->states.size(); ++i) {
          const auto patch = contact_patch(s->contacts[i], s->states[i]);
          RimForce sum_of;
          for (const auto& point : patch.points) {
            EXPECT_LE(point.traction[0], 0);
            EXPECT_LE(std::abs(point.traction[1]), friction * std::abs(point.traction[0]) * (1 + 1e-14));
            const Vec<2> n{std::cos(point.frame.tilt), std::sin(point.frame.tilt)};
            const Vec<2> t{point.traction[0] * n[0] - point.traction[1] * n[1],
                           point.traction[0] * n[1] + point.traction[1] * n[0]};
            sum_of = sum(sum_of, scaled(point.weight, resultant<2>(t, point.position)));
          }
          EXPECT_NEAR(sum_of.towards_ground, -model.load, 1e-9 * model.load) << name;
          if (force != 0)
            EXPECT_NEAR(sum_of.along_ground, -model.horizontal_force, 1e-9 * model.load) << name;
          EXPECT_NEAR(sum_of.along_ground, -patch.rim_force.along_ground, 1e-9 * model.load) << name;
          EXPECT_NEAR(sum_of.torque, -patch.rim_force.torque, 1e-9 * model.load) << name;
        }
      }
}

// Where the pressure is found, the tread lies on the ground: the gap is closed up to the pressure that the
// contact method allows.
TEST(RollingGround, TheTreadTouchesWhereItIsPressed) {
  for (const auto& [name, ground] : grounds) {
    auto model = lopsided_model(ground);
    model.contact.method = ContactMethod::penalty;
    model.contact.gamma_0 = 1e4;
    const auto problem = RollingProblem<2>::create(model);
    const auto s = problem->solve(generic_hole(model.grid));
    ASSERT_TRUE(s) << name << ": " << s.failure().detail;
    for (int i = 0; i < s->positions.size(); ++i)
      for (const auto& point : contact_patch(s->contacts[i], s->states[i]).points) {
        Vec<2> v;
        std::copy_n(s->observations.column(i * problem->tread().n_columns() + point.column) +
                        problem->tread().observation_rows().displacement(point.point),
                    2, v.begin());
        v = point.frame.to_ground<2>(v);
        const Vec<2> rim = displacement<2>(s->states[i].rim, point.position);
        const double gap = point.gap - std::cos(point.frame.tilt) * (v[0] + rim[0]) -
                           std::sin(point.frame.tilt) * (v[1] + rim[1]);
        EXPECT_GT(gap, -1e-3 * std::abs(s->states[i].rim.towards_ground)) << name;
        if (point.traction[0] < 0) EXPECT_LT(gap, 1e-9) << name;
      }
  }
}

// The rise of the energy is the work of the load, with symmetric contact.
TEST(RollingGround, TheForceIsTheDerivativeOfTheEnergyByTheTravel) {
  for (const auto& [name, ground] : grounds) {
    auto model = lopsided_model(ground);
    model.contact.method = ContactMethod::penalty;
    model.contact.gamma_0 = 1e3;
    model.ghost.xi = 1e-6;  // its energy is not counted
    const auto psi = generic_hole(model.grid);
    const double travel = 0.6e-3, step = 1e-6;
    const auto at = [&](double d) {
      model.travel = d;
      return *RollingProblem<2>::create(model)->solve(psi);
    };
    const auto before = at(travel - step), middle = at(travel), after = at(travel + step);
    for (int i = 0; i < middle.positions.size(); ++i) {
      // In the springs between tread and ground, too.
      const auto energy = [&](const RollingSolution<2>& s) {
        double springs = 0;
        for (const auto& point : contact_patch(s.contacts[i], s.states[i]).points) {
          const double gamma = s.contacts[i].points()[0].gamma;
          springs += 0.5 * point.weight * point.traction[0] * point.traction[0] / gamma;
        }
        return s.strain_energy[i] + springs;
      };
      const double force = middle.states[i].rim_force.towards_ground;
      EXPECT_NEAR((energy(after) - energy(before)) / (2 * step), force, 1e-5 * force) << name;
    }
  }
}

// The error of flat ground is of order 1 / R.
TEST(RollingGround, ALargeDrumIsFlat) {
  const auto flat = *solved(lopsided_model({}));
  for (const auto make : {Ground::drum, Ground::internal_drum}) {
    const double coarse = difference(*solved(lopsided_model(make(100))), flat),
                 fine = difference(*solved(lopsided_model(make(1000))), flat);
    EXPECT_LT(fine, 1e-3);
    EXPECT_NEAR(coarse / fine, 10, 0.5);
  }
}

TEST(RollingGround, AProfileIsWhatItsPointsShow) {
  const auto flat = *solved(lopsided_model({}, 0.3));
  EXPECT_LT(
      difference(*solved(lopsided_model(Ground::profile({{-1, 0}, {-0.01, 0}, {0.02, 0}, {1, 0}}), 0.3)),
                 flat),
      1e-12);
  std::vector<Vec<2>> points;
  for (int k = -1000; k <= 1000; ++k) {
    const double x = 1e-4 * k;
    points.push_back({x, std::sqrt(0.25 - x * x) - 0.5});
  }
  EXPECT_LT(difference(*solved(lopsided_model(Ground::profile(points))), *solved(lopsided_model(drum))),
            1e-5);
}

// An obstacle out of reach leaves flat ground.
TEST(RollingGround, AFarObstacleDoesNotMatter) {
  const auto flat = *solved(lopsided_model({}, 0.3));
  EXPECT_LT(difference(*solved(lopsided_model(Ground::bar(0.3, 0.02, 0.04), 0.3)), flat), 1e-12);
  EXPECT_LT(difference(*solved(lopsided_model(Ground::kerb(0.3, 0.05, 0.01), 0.3)), flat), 1e-12);
}

LevelSet<2> turned(LevelSet<2> psi, int columns) {
  const LevelSet<2> before = psi;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    auto p = psi.lattice.node_position(node);
    p[1] += psi.lattice.degree() * columns;
    psi.values[psi.lattice.node_index(p)] = before.values[node];
  }
  return psi;
}

TEST(RollingGround, AWheelTurnedByAColumnIsTheSame) {
  for (const auto& [name, ground] : grounds) {
    const auto problem = RollingProblem<2>::create(lopsided_model(ground, 0.3));
    const auto psi = generic_hole(problem->model().grid);
    const auto at = [&](const LevelSet<2>& shape, int column) {
      return *problem->solve(shape, {{{column, 0.3}}, {1}});
    };
    EXPECT_LT(difference(at(turned(psi, 1), 3), at(psi, 2)), 1e-9) << name;
  }
}

// The mirror image of the wheel on that of the ground.
TEST(RollingGround, TheMirrorImageOfAWheelRollsOnTheMirrorImageOfTheGround) {
  const auto image = [](const std::vector<Vec<2>>& points) {
    std::vector<Vec<2>> result;
    for (auto point = points.rbegin(); point != points.rend(); ++point)
      result.push_back({-(*point)[0], (*point)[1]});
    return Ground::profile(result);
  };
  const std::vector<Vec<2>> points{{-0.1, 0.002}, {-0.02, 0}, {0.02, 0.003}, {0.1, 0.001}};
  const auto model = lopsided_model(Ground::profile(points), 0.3),
             mirrored = lopsided_model(image(points), 0.3);
  ASSERT_FALSE(is_mirror_symmetric(model));
  const double sector = model.grid.sector_angle();
  const auto psi = generic_hole(model.grid);
  const auto psi_image = testing::holes(model.grid, 2, {{0.2681, (1 - 0.47) * sector, 0.0373}});
  const int columns = model.grid.columns();
  const auto here = *RollingProblem<2>::create(model)->solve(psi, {{{3}}, {1}});
  const auto there = *RollingProblem<2>::create(mirrored)->solve(psi_image, {{{columns - 3}}, {1}});
  EXPECT_LT(difference(there, here), 1e-7);
  EXPECT_NEAR(there.states[0].rim_force.along_ground, -here.states[0].rim_force.along_ground,
              1e-7 * model.load);
}

// One factorization serves every ground.
TEST(RollingGround, StatesOnOtherGroundsAgreeWithTheirOwnSolver) {
  const auto problem = RollingProblem<2>::create(lopsided_model({}, 0.3));
  const auto psi = generic_hole(problem->model().grid);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  for (const auto& [name, ground] : grounds) {
    const auto model = lopsided_model(ground, 0.3);
    const auto other = (*state)->under(model, Interrupt());
    ASSERT_TRUE(other) << name << ": " << other.failure().detail;
    const auto own = testing::all_states<2>(*RollingProblem<2>::create(model), psi);
    const auto contacts = (*state)->contacts_under(std::span(&model, 1), {}).front();
    ASSERT_TRUE(contacts);
    for (int i = 0; i < model.n_positions; ++i) {
      const double travel = (*own)->contacts()[i].travel();
      EXPECT_NEAR((*other)->strain_energy()[i] / (*own)->strain_energy()[i], 1, 1e-9) << name;
      EXPECT_NEAR((*other)->contacts()[i].travel() / travel, 1, 1e-9) << name;
      EXPECT_NEAR((*contacts)[i].travel() / travel, 1, 1e-9) << name;
    }
  }
}

// The forces over the way are those of a wheel whose ground is there; behind and ahead a bar pushes in
// opposite directions.
TEST(RollingGround, APassIsASequenceOfGrounds) {
  for (const std::optional<double> travel : {std::optional<double>(), std::optional(0.6e-3)}) {
    auto model = lopsided_model(bar);
    model.travel = travel;
    const auto problem = RollingProblem<2>::create(model);
    const auto psi = generic_hole(model.grid);
    const auto state = testing::all_states<2>(*problem, psi);
    const double step = travel ? 0.005 : 0.05;  // the axle keeps its height: the bar stays in reach
    const std::vector<double> shifts{-step, 0, step};
    const auto pass = ground_pass<2>(**state, shifts);
    for (size_t k = 0; k < shifts.size(); ++k) {
      auto there = model;
      there.ground = Ground::bar(0.01 + shifts[k], 0.02, 0.02);
      EXPECT_NEAR(pass[k].rise, there.ground.standing(0.34).rise, 1e-12);
      if (travel) *there.travel += pass[k].rise - model.ground.standing(0.34).rise;
      const auto own = testing::all_states<2>(*RollingProblem<2>::create(there), psi);
      ASSERT_TRUE(own && pass[k].positions);
      for (int i = 0; i < model.n_positions; ++i) {
        const ContactSummary expected = contact_summary((*own)->contacts()[i]);
        EXPECT_NEAR((*pass[k].positions)[i].radial_force, expected.radial_force, 1e-8 * model.load);
        EXPECT_NEAR((*pass[k].positions)[i].friction_force, expected.friction_force, 1e-8 * model.load);
        EXPECT_NEAR((*pass[k].positions)[i].travel, expected.travel, 1e-8 * std::abs(expected.travel));
      }
    }
    if (!travel)
      EXPECT_LT((*pass[0].positions)[0].friction_force * (*pass[2].positions)[0].friction_force, 0);
  }
}

TEST(RollingGround, ShapeGradientsPassTheTaylorTest) {
  for (const auto& [name, ground] : grounds)
    for (const double theta : {-1.0, 1.0}) {
      auto model = testing::with_theta(lopsided_model(ground, 0.3), theta);
      model.tread.levels = 1;
      const auto problem = RollingProblem<2>::create(model);
      for (const auto& terms : {strain_energy_alone(), WeightedSum<2>{{1, std::make_shared<Travel<2>>()}}}) {
        const auto test = generic_taylor_test(*problem, terms);
        ASSERT_TRUE(test) << name << ": " << test.failure().detail;
        // The largest step moves a point of the ring in the drum into contact.
        for (size_t k = 1; k < test->orders.size(); ++k)
          EXPECT_GT(test->orders[k], 1.99) << name << ", theta " << theta;
      }
    }
}

TEST(RollingGround, ForcesAtAPrescribedTravelPassTheTaylorTest) {
  for (const auto& [name, ground] : grounds) {
    auto model = lopsided_model(ground, 0.3);
    model.tread.levels = 1;
    model.travel = 0.6e-3;
    const auto problem = RollingProblem<2>::create(model);
    for (const RimWay way : {RimWay::towards_ground, RimWay::along_ground, RimWay::rotation}) {
      const auto test = generic_taylor_test(*problem, {{1, std::make_shared<GroundForce<2>>(way)}});
      ASSERT_TRUE(test) << name << ": " << test.failure().detail;
      // The largest step moves a point into contact.
      for (size_t k = 1; k < test->orders.size(); ++k) EXPECT_GT(test->orders[k], 1.9) << name;
    }
  }
}

TEST(RollingGround, ARotatingWheelOnADrumPassesTheTaylorTest) {
  auto model = lopsided_model(drum, 0.3);
  model.tread.levels = 1;
  model.materials = Material{200e6, 0.48, Plane::strain, 1100};
  model.distributed.angular_speed = 30;
  const auto problem = RollingProblem<2>::create(model);
  const auto test = generic_taylor_test(*problem, {{1, std::make_shared<Travel<2>>()}});
  ASSERT_TRUE(test) << test.failure().detail;
  for (double order : test->orders) EXPECT_GT(order, 1.9);
}

/// A wheel with its width on a drum, which leans and is pushed.
RollingModel<3> small_wheel(const Ground& ground) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, 2}};
  model.degree = 1;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.n_positions = 2;
  model.contact_points = 3;
  model.contact.friction = 0.3;
  model.ground = ground;
  return model;
}

LevelSet<3> uneven_hole(const PolarGrid<3>& grid, std::vector<double>& direction) {
  const Circle hole{0.2581, 0.47 * grid.sector_angle(), 0.0273};
  auto psi = make_level_set<3>(Lattice<3>(grid, 1), std::span(&hole, 1));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    psi.values[i] += 0.002 * std::cos(20 * p[2]);
    direction.push_back(1 + 0.4 * std::cos(16 * p[1]) + 0.3 * std::sin(15 * p[2]));
  }
  return psi;
}

TEST(RollingGround, In3DForcesBalanceAndTheGradientPassesTheTaylorTest) {
  for (const bool leans : {true, false}) {
    RollingModel<3> model = small_wheel(leans ? drum : bar);
    if (leans) {
      model.camber = 0.01;
      model.lateral_force = 100;
    }
    const auto problem = RollingProblem<3>::create(model);
    ASSERT_TRUE(problem);
    std::vector<double> direction;
    const auto psi = uneven_hole(model.grid, direction);
    const auto state = testing::all_states<3>(*problem, psi);
    ASSERT_TRUE(state) << state.failure().detail;
    for (const auto& patch : (*state)->contacts()) {
      Vec<3> sum_of{};
      for (const auto& point : patch.points)
        for (int d = 0; d < 3; ++d) sum_of[d] += point.weight * point.ground_traction()[d];
      EXPECT_NEAR(sum_of[0], -model.load, 1e-9 * model.load);
      EXPECT_NEAR(sum_of[1], -patch.rim_force.along_ground, 1e-9 * model.load);
      if (leans) EXPECT_NEAR(sum_of[2], -model.lateral_force, 1e-9 * model.load);
    }
    for (const WeightedSum<3>& terms : {WeightedSum<3>{{1, std::make_shared<StrainEnergy<3>>()}},
                                        WeightedSum<3>{{1, std::make_shared<Travel<3>>()}}}) {
      const auto test = taylor_test<3>(
          [&](const LevelSet<3>& shape) { return testing::evaluate_objective<3>(*problem, terms, shape); },
          psi, direction, model.degree, 2e-5, 3);
      ASSERT_TRUE(test) << test.failure().detail;
      for (double order : test->orders) EXPECT_GT(order, 1.9) << leans;
    }
  }
}

}  // namespace
}  // namespace wheelwright
