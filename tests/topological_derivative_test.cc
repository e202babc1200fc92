#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/support.h"
#include "wheelwright/mechanics/elasticity/orthotropic_law.h"
#include "wheelwright/mechanics/elasticity/small_hole.h"
#include "wheelwright/quantities/functionals/mass.h"
#include "wheelwright/quantities/functionals/material_volume.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/perimeter.h"
#include "wheelwright/quantities/functionals/rolling_resistance.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/ball.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using testing::holes;
using testing::paper_model;

template <size_t n>
double product(const std::array<double, n>& a, const std::array<double, n>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Half of sigma:eps.
template <int dim>
class EnergyDensity : public DensityOfStrain<dim> {
 public:
  typename DensityOfStrain<dim>::Value at(const Voigt<dim>& e, const MaterialLaw<dim>& law) const override {
    const Voigt<dim> sigma = stress<dim>(law, e);
    return {0.5 * product(sigma, e), sigma};
  }
};

const Material some{2.7e6, 0.31}, thin{2.7e6, 0.31, Plane::stress};
const Voigt<2> some_strain{0.013, -0.004, 0.009};

const Voigt<3> some_strain_in_space{0.013, -0.004, 0.002, -0.003, 0.007, 0.009};

TEST(SmallHole, HasNoTraction) {
  for (const Material& material : {some, thin})
    for (const double angle : {0.0, 0.7, 2.1, 4.4}) {
      const Vec<2> n{std::cos(angle), std::sin(angle)};
      Voigt<2> all = strain_around_hole(material, some_strain, n);
      for (int k = 0; k < 3; ++k) all[k] += some_strain[k];
      const Vec<2> t = traction<2>(stress<2>(material, all), n);
      EXPECT_NEAR(t[0], 0, 1e-9 * material.mu());
      EXPECT_NEAR(t[1], 0, 1e-9 * material.mu());
    }
}

/// The strain of the hole is that of its edge: along the edge both agree.
TEST(SmallHole, StretchesAsTheMaterialAtItsEdge) {
  for (const Material& material : {some, thin})
    for (const double angle : {0.0, 0.7, 2.1, 4.4}) {
      const double c = std::cos(angle), s = std::sin(angle);
      Voigt<2> outside = strain_around_hole(material, some_strain, {c, s});
      for (int k = 0; k < 3; ++k) outside[k] += some_strain[k];
      const Voigt<2> along{s * s, c * c, -s * c};
      const Voigt<2> hole = strain_of_hole<2>(material, some_strain);
      EXPECT_NEAR(product(outside, along), product(hole, along), 1e-12);
    }
}

TEST(SmallHole, IsThatOfTheFormulaInInvariants) {
  const Voigt<2> u = some_strain, p{-0.002, 0.011, 0.0043};
  for (const Material& material : {some, thin}) {
    const double lambda = material.lambda(), mu = material.mu();
    const Voigt<2> sigma = stress<2>(material, u);
    const double trace_s = sigma[0] + sigma[1], trace_p = p[0] + p[1];
    const double formula = (lambda + 2 * mu) / (2 * mu * (lambda + mu)) *
                           (4 * mu * product(sigma, p) + (lambda - mu) * trace_s * trace_p);
    EXPECT_NEAR(product(stress<2>(material, p), strain_of_hole<2>(material, u)), formula,
                1e-12 * std::abs(formula));
  }
}

/// In pure tension of plane stress a hole takes three times the energy that its own area held: 3 pi a^2 s^2 /
/// (2 E) (Inglis); all round it takes as much as the same edge with the ring's stress of Lame: twice sigma^2
/// / E.
TEST(SmallHole, TakesTheEnergyOfInglisAndLame) {
  const double e = thin.youngs_modulus, nu = thin.poissons_ratio, s = 1e4;
  const Voigt<2> tension{s / e, -nu * s / e, 0}, all_round{s * (1 - nu) / e, s * (1 - nu) / e, 0};
  EXPECT_NEAR(0.5 * product(stress<2>(thin, tension), strain_of_hole<2>(thin, tension)), 1.5 * s * s / e,
              1e-9 * s * s / e);
  EXPECT_NEAR(0.5 * product(stress<2>(thin, all_round), strain_of_hole<2>(thin, all_round)), 2 * s * s / e,
              1e-9 * s * s / e);
}

const std::vector<Vec<3>> directions{
    {1, 0, 0}, {0, 0, 1}, {0.6, 0, 0.8}, {2.0 / 3, -1.0 / 3, 2.0 / 3}, {-0.48, 0.64, 0.6}};

TEST(SmallHole, HasNoTractionInSpace) {
  for (const Vec<3>& n : directions) {
    Voigt<3> all = strain_around_hole(some, some_strain_in_space, n);
    for (int k = 0; k < 6; ++k) all[k] += some_strain_in_space[k];
    const Vec<3> t = traction<3>(stress<3>(some, all), n);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(t[d], 0, 1e-9 * some.mu());
  }
}

/// The divergence of the stress by central differences, which are of second order.
TEST(SmallHole, IsInEquilibriumInSpace) {
  const auto stress_at = [](const Vec<3>& x) {
    return stress<3>(some, strain_around_hole(some, some_strain_in_space, x));
  };
  constexpr int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  const double h = 1e-4;
  for (const Vec<3>& n : directions)
    for (const double r : {1.0, 1.7}) {
      Vec<3> divergence{};
      for (int j = 0; j < 3; ++j) {
        Vec<3> after = r * n, before = r * n;
        after[j] += h;
        before[j] -= h;
        const Voigt<3> later = stress_at(after), earlier = stress_at(before);
        for (int i = 0; i < 3; ++i)
          divergence[i] += (later[component[i][j]] - earlier[component[i][j]]) / (2 * h);
      }
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(divergence[i], 0, 1e-5 * some.mu() * 0.01 / r);
    }
}

/// On its surface both have the same strain along it, so that the hole moves as the material around it.
TEST(SmallHole, StretchesAsTheMaterialAtItsSurface) {
  const Voigt<3> hole = strain_of_hole<3>(some, some_strain_in_space);
  for (const Vec<3>& n : directions) {
    Voigt<3> outside = strain_around_hole(some, some_strain_in_space, n);
    for (int k = 0; k < 6; ++k) outside[k] += some_strain_in_space[k] - hole[k];
    const Vec<3> a{n[1], -n[0], 0}, b{n[2], 0, -n[0]};  // along the surface
    for (const auto& [s, t] : {std::pair(a, a), std::pair(a, b), std::pair(b, b)}) {
      const Voigt<3> along{s[0] * t[0],
                           s[1] * t[1],
                           s[2] * t[2],
                           0.5 * (s[1] * t[2] + s[2] * t[1]),
                           0.5 * (s[0] * t[2] + s[2] * t[0]),
                           0.5 * (s[0] * t[1] + s[1] * t[0])};
      EXPECT_NEAR(product(outside, along), 0, 1e-14);
    }
  }
}

TEST(SmallHole, OfThreeDimensionsStretchesAsLamesAndGoodiersCavity) {
  const double nu = some.poissons_ratio, s = 1e4, strain = s * (1 - 2 * nu) / some.youngs_modulus;
  const Voigt<3> all_round{strain, strain, strain, 0, 0, 0};
  const Voigt<3> hole = strain_of_hole<3>(some, all_round);
  // Its radius grows by 3 (1 - nu) / (2 E) s per unit: Lame's cavity in an unbounded body.
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(hole[d], 1.5 * (1 - nu) * s / some.youngs_modulus, 1e-15);
  // In shear: 15 (1 - nu) / (7 - 5 nu) times the distant one (Goodier 1933).
  const Voigt<3> shear = strain_of_hole<3>(some, {0, 0, 0, 0, 0, 1e-3});
  EXPECT_NEAR(shear[5], 1e-3 * 15 * (1 - nu) / (7 - 5 * nu), 1e-15);
}

TEST(TopologicalDerivative, OfTheEnergyAsADensityIsKnown) {
  for (const Material& material : {some, thin}) {
    const Voigt<2> sigma = stress<2>(material, some_strain), hole = strain_of_hole<2>(material, some_strain);
    const double expected = -0.5 * product(sigma, hole), one[] = {1};
    EXPECT_NEAR(removed_density<2>(EnergyDensity<2>(),
                                   {one_strain<2>(some_strain), 1, IsotropicLaw<2>(material)}, one),
                expected, 1e-9 * std::abs(expected));
  }
  const Voigt<3> sigma = stress<3>(some, some_strain_in_space);
  const double expected = -0.5 * product(sigma, strain_of_hole<3>(some, some_strain_in_space)), one[] = {1};
  EXPECT_NEAR(removed_density<3>(EnergyDensity<3>(),
                                 {one_strain<3>(some_strain_in_space), 1, IsotropicLaw<3>(some)}, one),
              expected, 1e-9 * std::abs(expected));
}

/// A wheel without symmetry; three holes in the sector.
LevelSet<2> lopsided(const PolarGrid<2>& grid, std::vector<testing::Hole> more = {}) {
  const double a = grid.sector_angle();
  std::vector<testing::Hole> all{{0.2471, 0.06 * a, 0.0153}, {0.2863, 0.41 * a, 0.0191}};
  all.insert(all.end(), more.begin(), more.end());
  return holes(grid, 2, all);
}

RollingModel<2> lopsided_model(int radial, int angular) {
  auto model = paper_model(radial, angular);
  model.grid.n_sectors = 8;
  model.grid.cells[1] = angular / 8;
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed = {.body_force = {3e4, 1e4}, .hole_pressure = 0};
  model.n_positions = 3;
  Material material = *model.materials.at_tread().isotropic();
  material.loss_factor = 0.2;
  model.materials = material;
  return model;
}

/// The cell and the point of the unit cell at a place.
MaterialPoint<2> point_at(const PolarGrid<2>& grid, double radius, double azimuth) {
  const Vec<2> h = grid.cell_size(0);
  const double x = (radius - grid.inner_radius) / h[0], y = azimuth / h[1];
  const std::array<int, 2> cell{static_cast<int>(x), static_cast<int>(y)};
  return {grid.cell_index(cell), {x - cell[0], y - cell[1]}};
}

std::vector<ShapeFunction<2>> some_functions(const StateSolver<2>& solver) {
  const auto dual = std::make_shared<UniformityDual<2>>(*solver.neumann_to_dirichlet(DualNorm::poisson));
  const auto energy = std::make_shared<StrainEnergy<2>>();
  return {{"energy", {{1, energy}}},
          {"sum", {{1, energy}, {1000, dual}}},
          {"weighted", {{1, energy}}, {0.2, 1.3, 0.7}},
          {"stress", {{1, std::make_shared<PeakVonMises<2>>(0, PeakNorm{.exponent = 4, .correction = 1})}}},
          {"resistance", {{1, std::make_shared<RollingResistance<2>>(solver.model())}}}};
}

std::vector<double> values(const StateSolver<2>& solver, const std::vector<ShapeFunction<2>>& functions,
                           const LevelSet<2>& psi) {
  const auto evaluated = evaluate<2>(solver, functions, psi);
  EXPECT_TRUE(evaluated) << evaluated.failure().detail;
  std::vector<double> result;
  for (const auto& f : evaluated->evaluation.functions) result.push_back(f.value);
  return result;
}

std::vector<std::vector<double>> derivatives(const StateSolver<2>& solver,
                                             const std::vector<ShapeFunction<2>>& functions,
                                             const LevelSet<2>& psi,
                                             const std::vector<MaterialPoint<2>>& points) {
  const auto state = testing::all_states<2>(solver, psi);
  EXPECT_TRUE(state) << state.failure().detail;
  const State<2>* const only = state->get();
  const auto result =
      topological_derivatives<2>(solver, {}, functions, psi, std::span(&only, 1), points, 1e-3);
  EXPECT_TRUE(result) << result.failure().detail;
  return *result;
}

struct Place {
  double radius, fraction;  ///< of the sector's angle
};

/// What finite holes of falling radii change per area, [radius][function].
std::vector<std::vector<double>> by_finite_holes(const StateSolver<2>& solver,
                                                 const std::vector<ShapeFunction<2>>& functions,
                                                 const Place& place, const std::vector<double>& radii) {
  const PolarGrid<2>& grid = solver.model().grid;
  const auto before = values(solver, functions, lopsided(grid));
  std::vector<std::vector<double>> result;
  for (const double r : radii) {
    result.push_back(
        values(solver, functions, lopsided(grid, {{place.radius, place.fraction * grid.sector_angle(), r}})));
    for (size_t f = 0; f < functions.size(); ++f)
      result.back()[f] = (result.back()[f] - before[f]) / (std::numbers::pi * r * r);
  }
  return result;
}

std::vector<std::vector<double>> derivatives_at(const StateSolver<2>& solver,
                                                const std::vector<ShapeFunction<2>>& functions,
                                                const std::vector<Place>& places) {
  const PolarGrid<2>& grid = solver.model().grid;
  std::vector<MaterialPoint<2>> points;
  for (const Place& place : places)
    points.push_back(point_at(grid, place.radius, place.fraction * grid.sector_angle()));
  return derivatives(solver, functions, lopsided(grid), points);
}

/// By which power of the radius the deviation falls from one hole to the next.
double order(double expected, const std::vector<double>& radii, const std::vector<double>& found, size_t k) {
  return std::log(std::abs((found[k] - expected) / (found[k + 1] - expected))) /
         std::log(radii[k] / radii[k + 1]);
}

/// What the changes by the two smallest holes tend to, whose deviation is of second order in the radius.
double limit(const std::vector<double>& radii, const std::vector<double>& found) {
  const size_t n = radii.size();
  const double larger = radii[n - 2] * radii[n - 2], smaller = radii[n - 1] * radii[n - 1];
  return (larger * found[n - 1] - smaller * found[n - 2]) / (larger - smaller);
}

std::vector<double> of_function(const std::vector<std::vector<double>>& found, size_t f) {
  std::vector<double> values;
  for (const auto& of_radius : found) values.push_back(of_radius[f]);
  return values;
}

/// On a wheel without symmetry, with friction, torque and body force.
TEST(TopologicalDerivative, IsTheLimitOfFiniteHoles) {
  const auto problem = RollingProblem<2>::create(lopsided_model(28, 384));
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto functions = some_functions(*problem);
  const Place place{0.2731, 0.68};
  const std::vector<double> radii{0.02, 0.014, 0.01};
  const auto found = by_finite_holes(*problem, functions, place, radii);
  const auto expected = derivatives_at(*problem, functions, {place});
  for (const size_t f : {0, 2, 4})
    EXPECT_NEAR(limit(radii, of_function(found, f)), expected[f][0], 0.02 * expected[f][0]);
  for (const size_t k : {0, 1}) {
    EXPECT_LT(std::abs(found[k + 1][0] - expected[0][0]), 0.5 * std::abs(found[k][0] - expected[0][0]));
    EXPECT_GT(order(expected[1][0], radii, of_function(found, 1), k), 1.8);
  }
}

/// The same in a material with polar axes.
TEST(TopologicalDerivative, IsTheLimitOfFiniteHolesInAnOrthotropicMaterial) {
  auto model = lopsided_model(28, 384);
  model.materials = Materials<2>(std::make_shared<OrthotropicLaw<2>>(OrthotropicMaterial{.modulus_r = 100e6,
                                                                                         .modulus_t = 500e6,
                                                                                         .modulus_z = 200e6,
                                                                                         .ratio_rt = 0.1,
                                                                                         .ratio_rz = 0.3,
                                                                                         .ratio_tz = 0.4,
                                                                                         .shear_rt = 60e6}));
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const std::vector<ShapeFunction<2>> functions{{"energy", testing::strain_energy_alone()}};
  const Place place{0.2731, 0.68};
  const std::vector<double> radii{0.02, 0.014, 0.01};
  const auto found = by_finite_holes(*problem, functions, place, radii);
  const auto expected = derivatives_at(*problem, functions, {place});
  // What is of second order in the radius falls out of the last two.
  const double r1 = radii[1] * radii[1], r2 = radii[2] * radii[2];
  const double limit = (found[2][0] * r1 - found[1][0] * r2) / (r1 - r2);
  EXPECT_NEAR(limit, expected[0][0], 0.02 * expected[0][0]);
  for (const size_t k : {0, 1})
    EXPECT_LT(std::abs(found[k + 1][0] - expected[0][0]), 0.6 * std::abs(found[k][0] - expected[0][0]));
}

/// The sector of a wheel in space without symmetry, with three balls and more.
LevelSet<3> lopsided_in_space(const PolarGrid<3>& grid, std::vector<Sphere> more = {}) {
  const double a = grid.sector_angle();
  auto psi = make_level_set<3>(Lattice<3>(grid, 2), {});
  for (const Sphere& hole :
       {Sphere{0.2471, 0.06 * a, 0.031, 0.0253}, Sphere{0.2863, 0.3 * a, 0.0801, 0.0161}})
    psi = with_hole(std::move(psi), hole);
  for (const Sphere& hole : more) psi = with_hole(std::move(psi), hole);
  return psi;
}

RollingModel<3> lopsided_model_in_space(std::array<int, 3> cells) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, cells};
  model.degree = 2;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.contact.friction = 0.4;
  model.torque = 200;
  model.distributed = {.body_force = {3e4, 1e4, 2e4}, .hole_pressure = 0};
  model.n_positions = 2;
  model.contact_points = 3;
  model.tread.annulus_points = 2;
  return model;
}

/// What changes by two balls tend to, whose deviation is of third order in the radius.
double limit_in_space(double larger, double change_by_larger, double smaller, double change_by_smaller) {
  const double a = std::pow(larger, 3), b = std::pow(smaller, 3);
  return (a * change_by_smaller - b * change_by_larger) / (a - b);
}

/// On a wheel in space without symmetry, with friction, torque and body force: of the energy, and of an
/// integral of stresses, which finer balls approach with a larger deviation.
TEST(TopologicalDerivative, SlowIsTheLimitOfFiniteBalls) {
  const auto problem = RollingProblem<3>::create(lopsided_model_in_space({14, 12, 8}));
  ASSERT_TRUE(problem) << problem.failure().detail;
  const PolarGrid<3>& grid = problem->model().grid;
  const std::vector<ShapeFunction<3>> functions{
      {"energy", {{1, std::make_shared<StrainEnergy<3>>()}}},
      {"stress", {{1, std::make_shared<PeakVonMises<3>>(0, PeakNorm{.exponent = 4, .correction = 1})}}}};
  const auto values_of = [&](const LevelSet<3>& psi) {
    const auto evaluated = evaluate<3>(*problem, functions, psi);
    EXPECT_TRUE(evaluated) << evaluated.failure().detail;
    std::vector<double> values;
    for (const auto& f : evaluated->evaluation.functions) values.push_back(f.value);
    return values;
  };
  const Vec<3> place{0.2731, 0.68 * grid.sector_angle(), 0.052};
  const auto psi = lopsided_in_space(grid);
  const auto before = values_of(psi);
  const std::vector<double> radii{0.028, 0.024, 0.02, 0.016};
  std::vector<std::vector<double>> found;
  for (const double r : radii) {
    found.push_back(values_of(lopsided_in_space(grid, {{place[0], place[1], place[2], r}})));
    for (size_t f = 0; f < functions.size(); ++f)
      found.back()[f] = (found.back()[f] - before[f]) / ball_measure<3>(r);
  }
  const auto state = testing::all_states<3>(*problem, psi);
  ASSERT_TRUE(state) << state.failure().detail;
  const State<3>* const only = state->get();
  const Vec<3> h = grid.cell_size(0);
  std::array<int, 3> cell;
  Vec<3> xi;
  for (int d = 0; d < 3; ++d) {
    const double x = (place[d] - (d == 0 ? grid.inner_radius : 0)) / h[d];
    cell[d] = static_cast<int>(x);
    xi[d] = x - cell[d];
  }
  const std::vector<MaterialPoint<3>> points{{grid.cell_index(cell), xi}};
  const auto expected =
      topological_derivatives<3>(*problem, {}, functions, psi, std::span(&only, 1), points, 1e-3);
  ASSERT_TRUE(expected) << expected.failure().detail;
  const auto limit_of = [&](size_t f, size_t larger, size_t smaller) {
    return limit_in_space(radii[larger], found[larger][f], radii[smaller], found[smaller][f]);
  };
  EXPECT_NEAR(limit_of(0, 0, 2), (*expected)[0][0], 0.02 * std::abs((*expected)[0][0]));
  EXPECT_NEAR(limit_of(1, 1, 3), (*expected)[1][0], 0.12 * std::abs((*expected)[1][0]));
}

TEST(TopologicalDerivative, SlowIsTheLimitOfFiniteHolesAtSeveralPlaces) {
  const auto problem = RollingProblem<2>::create(lopsided_model(56, 768));
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto functions = some_functions(*problem);
  const std::vector<Place> places{{0.2613, 0.24}, {0.2731, 0.68}, {0.2512, 0.83}};
  const std::vector<double> radii{0.01, 0.007, 0.005};
  const auto expected = derivatives_at(*problem, functions, places);
  for (size_t i = 0; i < places.size(); ++i) {
    const auto found = by_finite_holes(*problem, functions, places[i], radii);
    for (const size_t f : {0, 2})
      EXPECT_NEAR(limit(radii, of_function(found, f)), expected[f][i], 0.015 * std::abs(expected[f][i]))
          << functions[f].name;
    for (const size_t k : {0, 1}) {
      const double rate = order(expected[1][i], radii, of_function(found, 1), k);
      EXPECT_GT(rate, 1.7);
      EXPECT_LT(rate, 2.8);
    }
    EXPECT_NEAR(found[2][3], expected[3][i], 0.15 * std::abs(expected[3][i]));
  }
}

/// Positions that stand for their images give what all positions give.
TEST(TopologicalDerivative, OfDistinctPositionsIsThatOfAll) {
  auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem) << problem.failure().detail;
  const auto functions = some_functions(*problem);
  const std::vector<ShapeFunction<2>> symmetric{functions[0], functions[1], functions[3]};
  const auto psi = testing::paper_holes(model.grid);
  const std::vector<MaterialPoint<2>> points{point_at(model.grid, 0.21, 0.03),
                                             point_at(model.grid, 0.31, 0.1)};
  const auto of_all = derivatives(*problem, symmetric, psi, points);
  const auto distinct = problem->distinct_positions(psi);
  ASSERT_TRUE(distinct.stand_for_images());
  const auto state = static_cast<const StateSolver<2>&>(*problem).states(psi, distinct, Interrupt());
  ASSERT_TRUE(state);
  const State<2>* const only = state->get();
  const auto of_distinct =
      topological_derivatives<2>(*problem, {}, symmetric, psi, std::span(&only, 1), points, 1e-3);
  ASSERT_TRUE(of_distinct);
  for (size_t f = 0; f < symmetric.size(); ++f)
    for (size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR((*of_distinct)[f][i], of_all[f][i], 1e-6 * std::abs(of_all[f][i])) << symmetric[f].name;
}

/// Of functions of the shape alone: what a hole takes, exactly.
TEST(TopologicalDerivative, OfTheShapeAloneIsThatOfTheHole) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const std::vector<ShapeFunction<2>> functions{
      {"volume", {{1, std::make_shared<MaterialVolume<2>>()}}},
      {"mass", {{2, std::make_shared<Mass<2>>(Material{200e6, 0.48, Plane::strain, 1100})}}},
      {"perimeter", {{1, std::make_shared<Perimeter<2>>()}}}};
  const auto found =
      derivatives(*problem, functions, testing::paper_holes(model.grid), {point_at(model.grid, 0.31, 0.1)});
  EXPECT_EQ(found[0][0], -1);
  EXPECT_EQ(found[1][0], -2 * 1100 * 16);
  EXPECT_NEAR(found[2][0], 2 / 1e-3, 1e-9);
}

TEST(TopologicalDerivative, IsRefusedUnderAPressureInTheHoles) {
  auto model = paper_model(14, 192);
  model.distributed.hole_pressure = 1e4;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = testing::paper_holes(model.grid);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  const State<2>* const only = state->get();
  const std::vector<MaterialPoint<2>> points{point_at(model.grid, 0.31, 0.1)};
  const auto found = topological_derivatives<2>(*problem, {}, some_functions(*problem), psi,
                                                std::span(&only, 1), points, 1e-3);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.failure().reason, FailureReason::unsupported_model);
}

}  // namespace
}  // namespace wheelwright
