// Wheels that are the same along or about the axle, and stay so.

#include "wheelwright/shape/geometry/invariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

constexpr Invariance both[] = {Invariance::along_axle, Invariance::about_axle};

PolarGrid<3> grid_of(int sectors, int columns) { return {0.20, 0.34, 0.12, sectors, {14, columns, 6}}; }

std::vector<double> random_field(std::size_t size, std::mt19937& random) {
  std::vector<double> field(size);
  for (double& x : field) x = std::normal_distribution<double>()(random);
  return field;
}

double product(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Three round holes in a sector without a mirror plane, or a groove in one side face.
LevelSet<3> shape_of(const Lattice<3>& lattice, Invariance invariance) {
  if (invariance == Invariance::along_axle)
    return make_level_set<3>(
        lattice, std::vector<Circle>{{0.235, 0.03, 0.018}, {0.30, 0.21, 0.022}, {0.262, 0.35, 0.02}});
  return with_hole(make_level_set<3>(lattice, std::span<const Circle>{}),
                   Groove{0.233, 0.305, 0, 0.071, 0.021});
}

/// The largest difference between nodes that should be equal (is_invariant() asks for none).
double spread(const LevelSet<3>& psi, Invariance invariance) {
  const int axis = invariance == Invariance::about_axle ? 1 : 2;
  double largest = 0;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    auto place = psi.lattice.node_position(node);
    place[axis] = 0;
    largest = std::max(largest, std::abs(psi.values[node] - psi.values[psi.lattice.node_index(place)]));
  }
  return largest;
}

TEST(Groove, HasItsVolume) {
  const Lattice<3> lattice(grid_of(16, 12), 2);
  const LevelSet<3> full = make_level_set<3>(lattice, std::span<const Circle>{});
  const double inner = 0.23, outer = 0.31, depth = 0.05, fillet = 0.02;
  const auto cut = [&](double face) {
    return 16 * (material_measure(full) -
                 material_measure(with_hole(full, Groove{inner, outer, face, depth, fillet})));
  };
  // Pappus: each missing corner is a square without its quarter of a disc.
  const double corner = fillet * fillet * (1 - std::numbers::pi / 4),
               from_edge = fillet * (10 - 3 * std::numbers::pi) / (12 - 3 * std::numbers::pi);
  const double expected = std::numbers::pi * (outer * outer - inner * inner) * depth -
                          2 * std::numbers::pi * corner * ((inner + from_edge) + (outer - from_edge));
  EXPECT_NEAR(cut(0) / expected, 1, 2e-3);
  EXPECT_NEAR(cut(lattice.grid().width) / expected, 1, 2e-3);
}

// Without fillets, Pappus; with them, the area of its corners: r^2 (cot(a / 2) - (pi - a) / 2) at angle a.
TEST(Groove, WithALeaningFloorHasItsVolume) {
  using std::numbers::pi;
  const Lattice<3> lattice(grid_of(16, 12), 2);
  const LevelSet<3> full = make_level_set<3>(lattice, std::span<const Circle>{});
  const double inner = 0.23, outer = 0.31, width = outer - inner, depth = 0.03, deepest = 0.07;
  const auto cut = [&](double face, double fillet) {
    return 16 * (material_measure(full) -
                 material_measure(with_hole(full, Groove{inner, outer, face, depth, fillet, deepest})));
  };
  // Trapezoid: area times the path of its centroid.
  const double mean = 0.5 * (depth + deepest), area = mean * width,
               centroid = inner + width * (depth + 2 * deepest) / (3 * (depth + deepest)),
               expected = 2 * pi * centroid * area;
  for (const double face : {0., lattice.grid().width}) EXPECT_NEAR(cut(face, 0) / expected, 1, 6e-3);
  const double fillet = 0.015, lean = std::atan((deepest - depth) / width);
  const auto corner = [&](double angle) {
    return fillet * fillet * (1 / std::tan(0.5 * angle) - 0.5 * (pi - angle));
  };
  const double rounded = expected - 2 * pi *
                                        (corner(0.5 * pi + lean) * (inner + 0.25 * fillet) +
                                         corner(0.5 * pi - lean) * (outer - 0.25 * fillet));
  for (const double face : {0., lattice.grid().width}) EXPECT_NEAR(cut(face, fillet) / rounded, 1, 2e-3);
}

// Against the nearest of many points of the boundary: two sides, and the floor between them.
TEST(Groove, WithALeaningFloorHasTheDistancesOfItsSides) {
  const Groove groove{0.23, 0.31, 0, 0.03, 0, 0.07};
  std::vector<Vec<2>> boundary;
  constexpr int n = 4000;
  for (int i = 0; i <= n; ++i) {
    const double t = double(i) / n;
    boundary.push_back({0.23, 0.03 * t});
    boundary.push_back({0.31, 0.07 * t});
    boundary.push_back({0.23 + 0.08 * t, 0.03 + 0.04 * t});
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.2, 0.34), height(0, 0.12);
  for (int k = 0; k < 200; ++k) {
    const Vec<2> x{radius(random), height(random)};
    double nearest = HUGE_VAL;
    for (const Vec<2>& y : boundary) nearest = std::min(nearest, norm(x - y));
    const bool is_inside = x[0] > 0.23 && x[0] < 0.31 && x[1] < 0.03 + 0.5 * (x[0] - 0.23);
    EXPECT_NEAR(signed_distance(grid_of(16, 12), groove, Vec<3>{x[0], 0.1, x[1]}),
                is_inside ? nearest : -nearest, 1e-5);
  }
}

TEST(Invariance, TheMeanIsAProjection) {
  const Lattice<3> lattice(grid_of(12, 8), 2);
  std::mt19937 random(3);
  for (const Invariance invariance : both) {
    const auto values = random_field(lattice.n_nodes(), random);
    const LevelSet<3> mean{lattice, invariant_part<3>(lattice, values, invariance)};
    EXPECT_EQ(spread(mean, invariance), 0);
    EXPECT_TRUE(is_invariant(mean, invariance));
    LevelSet<3> other = mean;
    other.values[lattice.n_nodes() / 2] += 1e-3 * lattice.grid().resolution();
    EXPECT_FALSE(is_invariant(other, invariance));
    const auto again = invariant_part<3>(lattice, mean.values, invariance);
    for (std::size_t i = 0; i < again.size(); ++i) EXPECT_NEAR(again[i], mean.values[i], 1e-14);
    // The load has the same product with all invariant fields, and no part for others.
    const auto load = random_field(lattice.n_nodes(), random);
    const auto of_lines = invariant_load<3>(lattice, load, invariance);
    EXPECT_NEAR(product(of_lines, mean.values), product(load, mean.values), 1e-11);
    EXPECT_NEAR(product(of_lines, values), product(load, mean.values), 1e-11);
  }
}

TEST(Invariance, RepresentativesAreThoseOfTheInvariantDeformations) {
  const Lattice<3> lattice(grid_of(12, 8), 2);
  std::vector<bool> fixed(lattice.n_nodes());
  for (int node = 0; node < lattice.n_nodes(); ++node) fixed[node] = lattice.polar_point(node)[0] < 0.215;
  std::mt19937 random(4);
  for (const Invariance invariance : both)
    for (const DeformationKind kind : {DeformationKind::normal_speed, DeformationKind::vector_field}) {
      const DeformationSpace<3> space(lattice, fixed, 0.02, kind, invariance);
      const std::size_t n = lattice.n_nodes() * space.n_components();
      const auto load = random_field(n, random);
      const auto found = space.representative(load);
      std::vector<double> direction;
      for (int k = 0; k < space.n_components(); ++k) {
        const auto part = invariant_part<3>(lattice, random_field(lattice.n_nodes(), random), invariance);
        for (int node = 0; node < lattice.n_nodes(); ++node)
          direction.push_back(fixed[node] ? 0 : part[node]);
        const LevelSet<3> component{
            lattice, {found.begin() + k * lattice.n_nodes(), found.begin() + (k + 1) * lattice.n_nodes()}};
        EXPECT_EQ(spread(component, invariance), 0);
      }
      EXPECT_NEAR(product(space.load(found), direction) / product(load, direction), 1, 1e-9);
    }
}

TEST(Invariance, EveryStageKeepsIt) {
  std::mt19937 random(5);
  for (const Invariance invariance : both)
    for (const ShapeSpace space : {ShapeSpace::spline, ShapeSpace::nodal}) {
      SCOPED_TRACE(static_cast<int>(invariance));
      const Lattice<3> lattice(grid_of(12, 12), 2);
      EvolutionOptions options{
          .velocity = {ExtensionKind::h1, 2}, .smoothing = 0.1, .bands = {{0.01, 1}, {0.02, 1}}};
      options.space = space;
      options.invariance = invariance;
      const Evolver<3> evolver(lattice, options);
      LevelSet<3> psi = invariant_part(shape_of(lattice, invariance), invariance);
      const double before = material_measure(psi);
      const auto velocity = evolver.deformations().speeds(
          psi, evolver.deformations().representative(
                   random_field(lattice.n_nodes() * evolver.deformations().n_components(), random)));
      psi = *evolver.move(psi, velocity, 0.7 * lattice.grid().resolution());
      EXPECT_EQ(spread(psi, invariance), 0);
      EXPECT_GT(std::abs(material_measure(psi) / before - 1), 1e-5);  // it did move
      psi = *evolver.redistance(psi);
      EXPECT_EQ(spread(psi, invariance), 0);
      psi = *evolver.smooth(psi);
      EXPECT_EQ(spread(psi, invariance), 0);
      psi = evolver.with_measure(psi, before, 1)->shape;
      EXPECT_EQ(spread(psi, invariance), 0);
      EXPECT_NEAR(material_measure(psi) / before, 1, 1e-5);
    }
}

TEST(Invariance, ATurnedWheelIsSolvedAtOnePositionUnlessItsHistoryMatters) {
  const std::string turned =
      "[wheel]\ndimension = 3\n[optimizer]\nmade = \"turned\"\n[[holes.groove]]\ninner_radius = 0.23\n"
      "outer_radius = 0.31\ndepth = 0.03\n[material]\n";
  const CaseResult plain = parse_case(turned, "case.toml"),
                   lossy = parse_case(turned + "loss_factor = 0.1\n", "case.toml");
  ASSERT_TRUE(plain.value && lossy.value);
  EXPECT_EQ(plain.value->load.positions, 1);
  EXPECT_EQ(lossy.value->load.positions, Load().positions);
  EXPECT_EQ(plain.value->grid.angular_cells, plain.value->wheel.sectors);
}

RollingModel<3> model_on(const PolarGrid<3>& grid) {
  RollingModel<3> model;
  model.grid = grid;
  model.materials = Material{200e6, 0.35};
  model.load = 2943;
  model.n_positions = 1;
  model.contact.friction = 0.4;
  model.torque = 80;
  model.lateral_force = 300;
  return model;
}

/// Results that must not depend on the number of sectors.
struct Rolled {
  double energy;
  RimMotion rim;
  std::vector<double> tractions, gradient_by_row;
};

// In sectors of one column, whose harmonics are sparse matrices of a section, and in those of the general
// solver.
TEST(Invariance, ATurnedWheelHasAnyNumberOfSectors) {
  const WeightedSum<3> energy{{1, std::make_shared<StrainEnergy<3>>()}};
  std::vector<Rolled> all;
  for (const int sectors : {8, 32, 96}) {
    const auto model = model_on(grid_of(sectors, 96 / sectors));
    const auto problem = RollingProblem<3>::create(model);
    ASSERT_TRUE(problem);
    const auto psi = shape_of(Lattice<3>(model.grid, 2), Invariance::about_axle);
    const auto s = problem->solve(psi);
    ASSERT_TRUE(s) << s.failure().detail;
    EXPECT_EQ(s->ring.harmonic_factor(1).of_section() != nullptr, sectors == 96);
    Rolled rolled{s->strain_energy[0], s->states[0].rim, {}, std::vector<double>(model.grid.cells[0])};
    for (const Vec<3>& t : s->states[0].traction)
      rolled.tractions.insert(rolled.tractions.end(), t.begin(), t.end());
    if (sectors > 8) {
      const auto evaluation = testing::evaluate_objective<3>(*problem, energy, psi);
      ASSERT_TRUE(evaluation);
      for (const auto& sample : evaluation->gradient("objective"))
        rolled.gradient_by_row[model.grid.cell_position(sample.cell)[0]] += sample.weight * sample.value;
    }
    all.push_back(std::move(rolled));
  }
  for (const Rolled& other : {all[1], all[2]}) {
    EXPECT_NEAR(other.energy / all[0].energy, 1, 1e-8);
    EXPECT_NEAR(other.rim.towards_ground / all[0].rim.towards_ground, 1, 1e-8);
    EXPECT_NEAR(other.rim.rotation / all[0].rim.rotation, 1, 1e-8);
    EXPECT_LT(testing::relative_difference(other.tractions, all[0].tractions), 1e-7);
  }
  EXPECT_LT(testing::relative_difference(all[2].gradient_by_row, all[1].gradient_by_row), 1e-7);
}

/// The derivative along an invariant deformation, from the shape gradient and by the load on deformations.
TEST(Invariance, TheGradientOfTheConstrainedShapePassesTheTaylorTest) {
  for (const Invariance invariance : both) {
    SCOPED_TRACE(static_cast<int>(invariance));
    auto model = model_on(invariance == Invariance::about_axle ? grid_of(96, 1) : grid_of(16, 3));
    model.cut_points = 8;
    const auto problem = RollingProblem<3>::create(model);
    ASSERT_TRUE(problem);
    const Lattice<3> lattice(model.grid, 2);
    const LevelSet<3> psi = invariance == Invariance::along_axle
                                ? make_level_set<3>(lattice, std::vector<Circle>{{0.2581, 0.17, 0.0273}})
                                : shape_of(lattice, invariance);
    std::vector<double> direction;
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const Vec<3> p = lattice.polar_point(node);
      direction.push_back(invariance == Invariance::along_axle ? 1 + 0.4 * std::cos(16 * p[1])
                                                               : 1 + 0.4 * std::sin(15 * p[2] + 20 * p[0]));
    }
    const WeightedSum<3> energy{{1, std::make_shared<StrainEnergy<3>>()}};
    const auto test = taylor_test<3>(
        [&](const LevelSet<3>& shape) { return testing::evaluate_objective<3>(*problem, energy, shape); },
        psi, direction, model.degree, 2e-4, 2);
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9);
  }
}

}  // namespace
}  // namespace wheelwright
