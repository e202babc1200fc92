// Rings of several materials: exact solutions, limits, and derivatives where holes cross from one to another.

#include "wheelwright/case/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/cad/outline/check_outline.h"
#include "wheelwright/cad/outline/cut_outline.h"
#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/mechanics/state/layer_measures.h"
#include "wheelwright/output/page/sector_mesh.h"
#include "wheelwright/output/report/layered_surface.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/quantities/analysis/finer_grid.h"
#include "wheelwright/quantities/analysis/layer_results.h"
#include "wheelwright/quantities/functionals/mass.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/quantities.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/layer_shapes.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/components.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::generic_hole;
using testing::paper_model;

template <int dim>
Materials<dim> layered(const std::vector<std::pair<double, Material>>& layers) {
  std::vector<typename Materials<dim>::Layer> result;
  for (const auto& [outer_radius, material] : layers)
    result.push_back({outer_radius, std::make_shared<IsotropicLaw<dim>>(material)});
  return Materials<dim>(std::move(result));
}

LevelSet<2> full(const PolarGrid<2>& grid) { return testing::holes(grid, 2, {}); }

/// The states of a shape, with the solver, which must outlive them.
std::shared_ptr<const State<2>> solved(const RollingModel<2>& model, const LevelSet<2>& psi) {
  using Solver = std::decay_t<decltype(*make_solver(model))>;
  using State = std::shared_ptr<const State<2>>;
  auto solver = make_solver(model);
  if (!solver) throw std::runtime_error(solver.failure().detail);
  const auto state = (*solver)->states(psi, (*solver)->all_positions(), Interrupt());
  if (!state) throw std::runtime_error(state.failure().detail);
  const auto both = std::make_shared<const std::pair<Solver, State>>(*std::move(solver), *state);
  return {both, both->second.get()};
}

/// A tread bonded to a rigid ring.
RollingModel<2> bushing(int radial_cells, int angular_cells) {
  auto model = paper_model(radial_cells, angular_cells);
  model.grid.n_sectors = 8;
  model.grid.cells[1] = angular_cells / 8;
  model.contact.counterpart = Counterpart::ring;
  model.contact_points = 3;
  model.n_positions = 1;
  return model;
}

/// The force per displacement of the rim of a bonded bush of layers [N/m per metre of width], by Kolosov's
/// potentials: 2 mu (u_x + i u_y) = p(r) + q(r) e^(2i theta), and the tractions on circles in the same form.
/// A layer has four terms: a translation, phi = z^2, phi = log z with psi = -kappa log z, and psi = 1 / z^2.
double radial_stiffness(double inner, const std::vector<std::pair<double, Material>>& layers) {
  struct Terms {
    double p[4], q[4], traction_p[4], traction_q[4];
  };
  const auto terms = [](const Material& m, double r) {
    const double nu = m.poissons_ratio, kappa = m.plane == Plane::strain ? 3 - 4 * nu : (3 - nu) / (1 + nu),
                 s = 1 / (2 * m.mu());
    return Terms{{1, -2 * r * r * s, 2 * kappa * std::log(r) * s, 0},
                 {0, kappa * r * r * s, -s, -s / (r * r)},
                 {0, 0, (1 + kappa) / r, 0},
                 {0, 2 * r, 2 / r, 2 / (r * r * r)}};
  };
  const int n = 4 * static_cast<int>(layers.size());
  Matrix a(n, n), b(n, 1);
  int row = 0;
  const auto put = [&](int layer, const double(&values)[4], double sign) {
    for (int k = 0; k < 4; ++k) a(row, 4 * layer + k) = sign * values[k];
  };
  const Terms at_rim = terms(layers.front().second, inner);
  put(0, at_rim.p, 1);
  b(row++, 0) = 1;
  put(0, at_rim.q, 1);
  ++row;
  for (int i = 0; i + 1 < static_cast<int>(layers.size()); ++i) {
    const double r = layers[i].first;
    const Terms below = terms(layers[i].second, r), above = terms(layers[i + 1].second, r);
    for (const auto member : {&Terms::p, &Terms::q, &Terms::traction_p, &Terms::traction_q}) {
      put(i, below.*member, 1);
      put(i + 1, above.*member, -1);
      ++row;
    }
  }
  const int last = static_cast<int>(layers.size()) - 1;
  const Terms at_tread = terms(layers.back().second, layers.back().first);
  put(last, at_tread.p, 1);
  ++row;
  put(last, at_tread.q, 1);
  const Matrix solution = LuFactor::factor(std::move(a))->solve(std::move(b));
  const Material& m = layers.front().second;
  const double nu = m.poissons_ratio, kappa = m.plane == Plane::strain ? 3 - 4 * nu : (3 - nu) / (1 + nu);
  return std::abs(2 * pi * (1 + kappa) * solution(2, 0));
}

double torsional_stiffness(double inner, const std::vector<std::pair<double, Material>>& layers) {
  double compliance = 0;
  for (const auto& [outer, material] : layers) {
    compliance += (1 / (inner * inner) - 1 / (outer * outer)) / (4 * pi * material.mu());
    inner = outer;
  }
  return 1 / compliance;
}

TEST(Layers, OfABushHaveTheExactStiffnesses) {
  const std::pair<double, double> on_lines{0.235, 0.27}, between_lines{0.2431, 0.2683};
  for (const auto& [radii, contrast] : {std::pair{on_lines, 1.0},
                                        {on_lines, 30.0},
                                        {on_lines, 1e5},
                                        {between_lines, 30.0},
                                        {between_lines, 1e5}})
    for (const Plane plane : {Plane::strain, Plane::stress}) {
      SCOPED_TRACE(contrast);
      const auto [first, second] = radii;
      const std::vector<std::pair<double, Material>> layers{
          {first, {2e6, 0.3, plane}}, {second, {2e6 * contrast, 0.35, plane}}, {0.34, {3e6, 0.48, plane}}};
      double errors[2], turns[2];
      for (const int level : {0, 1}) {
        auto model = bushing(8 << level, 64 << level);
        model.materials = layered<2>(layers);
        model.grid = with_lines_at(model.grid, model.materials.interfaces());
        const double exact = radial_stiffness(0.2, layers);
        const auto state = solved(model, full(model.grid));
        errors[level] = std::abs(model.load / state->contacts()[0].rim.towards_ground / exact - 1);
        model.torque = 1000;
        const auto turned = solved(model, full(model.grid));
        turns[level] = std::abs(
            model.torque / turned->contacts()[0].rim.rotation / torsional_stiffness(0.2, layers) - 1);
      }
      EXPECT_LT(errors[1], 2e-4);
      EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
      EXPECT_LT(turns[1], 1e-4);
      EXPECT_GT(std::log2(turns[0] / turns[1]), 1.8);
    }
}

TEST(Layers, OfTheSameMaterialAreOneMaterial) {
  auto model = paper_model(14, 192);
  model.n_positions = 2;
  const auto whole = solved(model, full(model.grid));
  model.materials = layered<2>({{0.24, {200e6, 0.48}}, {0.33, {200e6, 0.48}}, {0.34, {200e6, 0.48}}});
  const auto in_parts = solved(model, full(model.grid));
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(in_parts->strain_energy()[i] / whole->strain_energy()[i], 1, 1e-12);
}

/// A core that is much stiffer than what lies on it is as good as a rim: the difference is of first order in
/// the ratio of the moduli.
TEST(Layers, OnAStiffCoreTendToAWheelOnARigidOne) {
  auto model = paper_model(14, 192);
  model.n_positions = 1;
  model.materials = Material{200e6, 0.45};
  const auto hole = [](const PolarGrid<2>& grid) {
    return testing::holes(grid, 2, {{0.291, 0.47 * grid.sector_angle(), 0.0173}});
  };
  auto on_rim = model;
  on_rim.grid.inner_radius = 0.24;
  on_rim.grid.cells[0] = 10;
  const double rigid = solved(on_rim, hole(on_rim.grid))->contacts()[0].travel();
  double differences[2];
  for (const int which : {0, 1}) {
    const double contrast = which == 0 ? 1e3 : 1e5;
    model.materials = layered<2>({{0.24, {200e6 * contrast, 0.3}}, {0.34, {200e6, 0.45}}});
    differences[which] = solved(model, hole(model.grid))->contacts()[0].travel() / rigid - 1;
  }
  EXPECT_GT(differences[1], 0);
  EXPECT_LT(differences[0], 5e-3);
  EXPECT_NEAR(differences[0] / differences[1], 100, 5);
}

/// Holes that cross from one material to another, without symmetry, with friction; also between rows of
/// unequal height.
TEST(Layers, ShapeGradientPassesTheTaylorTest) {
  for (const auto& [contrast, interface] :
       {std::pair{0.02, 0.27}, {50.0, 0.27}, {0.02, 0.2664}, {50.0, 0.2664}})
    for (const double nu : {0.3, 0.4999}) {
      SCOPED_TRACE(::testing::Message() << contrast << " at " << interface);
      auto model = paper_model(14, 192);
      model.n_positions = 3;
      model.contact.friction = 0.3;
      model.horizontal_force = 0.1 * model.load;
      model.materials = layered<2>({{interface, {200e6 * contrast, nu, Plane::strain, 8000}},
                                    {0.34, {200e6, 0.3, Plane::strain, 1100}}});
      model.grid = with_lines_at(model.grid, {interface});
      const auto problem = RollingProblem<2>::create(model);
      ASSERT_TRUE(problem);
      for (const WeightedSum<2>& terms :
           {testing::strain_energy_alone(), WeightedSum<2>{{1, std::make_shared<Travel<2>>()}},
            WeightedSum<2>{{1, std::make_shared<Mass<2>>(model.materials)}}}) {
        const auto test = testing::generic_taylor_test(*problem, terms);
        ASSERT_TRUE(test) << test.failure().detail;
        for (const double order : test->orders) EXPECT_GT(order, 1.9) << terms.front().functional->name();
      }
    }
}

/// The quantities of a layer, where holes cross from one to another. In the norm of the peak the correction
/// is held, as the gradient takes it.
TEST(Layers, QuantitiesOfOneLayerPassTheTaylorTest) {
  for (const double contrast : {0.02, 50.0}) {
    auto model = paper_model(14, 192);
    model.n_positions = 3;
    model.contact.friction = 0.3;
    model.horizontal_force = 0.1 * model.load;
    model.materials = layered<2>(
        {{0.27, {200e6 * contrast, 0.4, Plane::strain, 8000}}, {0.34, {200e6, 0.3, Plane::strain, 1100}}});
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem);
    for (const PartOfRing& part : {PartOfRing{"core", 0.20, 0.27}, PartOfRing{"tyre", 0.27, 0.34}})
      for (const WeightedSum<2>& terms :
           {WeightedSum<2>{
                {1e-6, std::make_shared<PeakVonMises<2>>(0, PeakNorm{.exponent = 4, .correction = 1}, part)}},
            WeightedSum<2>{{1, std::make_shared<Mass<2>>(model.materials, part)}}}) {
        SCOPED_TRACE(terms.front().functional->name());
        const auto test = testing::generic_taylor_test(*problem, terms);
        ASSERT_TRUE(test) << test.failure().detail;
        for (const double order : test->orders) EXPECT_GT(order, 1.9) << contrast;
      }
  }
}

/// Peaks and masses of the layers: the larger is that of the ring, the sum is that of the ring, and a
/// functional of one layer sees what its results say.
TEST(Layers, HaveResultsOfTheirOwn) {
  auto model = paper_model(14, 192);
  model.n_positions = 3;
  model.contact.friction = 0.3;
  model.horizontal_force = 0.1 * model.load;
  model.materials =
      layered<2>({{0.27, {2e9, 0.3, Plane::strain, 8000}}, {0.34, {200e6, 0.4, Plane::strain, 1100}}});
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const LevelSet<2> psi = generic_hole(model.grid);
  const auto states = problem->states(psi, problem->all_positions(), Interrupt());
  ASSERT_TRUE(states) << states.failure().detail;
  const auto& state = *states;
  const auto layers = layer_results<2>(*problem, *state);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(std::max(layers[0].peak_von_mises, layers[1].peak_von_mises),
            std::ranges::max(state->strain_peaks().von_mises));
  EXPECT_EQ(std::max(layers[0].largest_strain, layers[1].largest_strain),
            std::ranges::max(state->strain_peaks().principal));
  EXPECT_LT(layers[0].peak_place[0], 0.27);
  EXPECT_GT(layers[1].peak_place[0], 0.27);
  const double mean = mean_density(model.materials, psi).value();
  EXPECT_NEAR((*layers[0].mass + *layers[1].mass) / (mean * material_measure(psi) * model.grid.n_sectors), 1,
              1e-12);
  const PartOfRing parts[] = {{"core", 0.20, 0.27}, {"tyre", 0.27, 0.34}};
  for (const int k : {0, 1}) {
    const auto value = [&](std::string_view quantity) {
      const auto term = functional_of<2>(in_part(built_in(quantity), parts[k]), Over::maximum, {*problem});
      return term->functional->evaluate(*problem, psi, *state, {});
    };
    EXPECT_NEAR(value("mass").of_shape / *layers[k].mass, 1, 1e-12);
  }
  // The p-th powers of the norms add up to that of the ring, and the larger peak is that of the ring.
  for (const PeakNorm& norm : {PeakNorm{.correction = 1}, PeakNorm()}) {
    const auto values = [&](const std::optional<PartOfRing>& part) {
      return PeakVonMises<2>(0, norm, part).evaluate(*problem, psi, *state, {}).by_position;
    };
    const auto core = values(parts[0]), tyre = values(parts[1]), ring = values({});
    for (std::size_t i = 0; i < ring.size(); ++i)
      EXPECT_NEAR(norm.correction ? std::pow(core[i] / ring[i], 16) + std::pow(tyre[i] / ring[i], 16)
                                  : std::max(core[i], tyre[i]) / ring[i],
                  1, 1e-12);
  }
}

/// A wheel with a hole across the interface on finer and finer grids.
TEST(Layers, WithAHoleAcrossThemConverge) {
  double energies[3];
  for (const int level : {0, 1, 2}) {
    auto model = paper_model(14 << level, 96 << level);
    model.n_positions = 1;
    model.contact.counterpart = Counterpart::ring;
    model.materials = layered<2>({{0.27, {200e6, 0.3}}, {0.34, {10e6, 0.45}}});
    energies[level] = solved(model, generic_hole(model.grid))->strain_energy()[0];
  }
  // The stress is singular where the interface meets the edge of the hole.
  EXPECT_LT(std::abs(energies[2] / energies[1] - 1), 5e-3);
  EXPECT_LT(std::abs(energies[2] - energies[1]), 0.6 * std::abs(energies[1] - energies[0]));
}

/// Across an interface the traction is continuous and the stress along it jumps.
TEST(Layers, HaveStressesOfTheirOwnAtAnInterface) {
  auto model = bushing(28, 192);
  model.materials = layered<2>({{0.27, {200e6, 0.3}}, {0.34, {10e6, 0.45}}});
  const auto state = solved(model, full(model.grid));
  const RingField stress = stress_field(model, state->domain(), state->displacement().at_nodes(0));
  const Lattice<2> lattice = displacement_lattice(model);
  const int line = lattice.degree() * model.grid.nearest_line(0.27).line;
  double traction = 0, traction_jump = 0, hoop_jump = 0;
  for (int k = 0; k < lattice.nodes()[1] * model.grid.n_sectors; ++k) {
    const size_t node = ring_node<2>(lattice, {line, k});
    const double azimuth = k * lattice.node_angle(), c = std::cos(azimuth), s = std::sin(azimuth);
    const auto parts = [&](const std::vector<double>& values) {
      const double* t = &values[stress.components * node];  // xx, yy, zz, xy
      return std::array{c * c * t[0] + s * s * t[1] + 2 * c * s * t[3],
                        c * s * (t[1] - t[0]) + (c * c - s * s) * t[3],
                        s * s * t[0] + c * c * t[1] - 2 * c * s * t[3]};
    };
    const auto inside = parts(stress.in_row(line / 2 - 1)), outside = parts(stress.in_row(line / 2));
    traction = std::max(traction, std::hypot(inside[0], inside[1]));
    traction_jump = std::max(traction_jump, std::hypot(inside[0] - outside[0], inside[1] - outside[1]));
    hoop_jump = std::max(hoop_jump, std::abs(inside[2] - outside[2]));
  }
  EXPECT_LT(traction_jump, 0.01 * traction);
  EXPECT_GT(hoop_jump, 0.3 * traction);
}

TEST(Layers, HaveTheMassOfTheirParts) {
  auto model = paper_model(14, 192);
  model.materials =
      layered<2>({{0.27, {200e6, 0.3, Plane::strain, 8000}}, {0.34, {10e6, 0.3, Plane::strain, 1000}}});
  const LevelSet<2> psi = full(model.grid);
  const double inner = pi * (0.27 * 0.27 - 0.2 * 0.2), outer = pi * (0.34 * 0.34 - 0.27 * 0.27);
  EXPECT_NEAR(mean_density(model.materials, psi).value(), (8000 * inner + 1000 * outer) / (inner + outer),
              1e-3);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto evaluation =
      testing::evaluate_objective<2>(*problem, {{1, std::make_shared<Mass<2>>(model.materials)}}, psi);
  ASSERT_TRUE(evaluation);
  EXPECT_NEAR(evaluation->function("objective").value, 8000 * inner + 1000 * outer, 1e-3);
}

TEST(Layers, EndOnLinesOfFinerGrids) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {14, 6, 4}};
  model.materials = layered<3>({{0.23, {200e6, 0.3}}, {0.34, {10e6, 0.3}}});
  ASSERT_TRUE(model.materials.fit(model.grid));
  const auto finer = on_finer_grid(model);
  EXPECT_TRUE(finer.materials.fit(finer.grid));
  EXPECT_LE(finer.grid.cells[0], 28);
  model.grid.cells[0] = 15;
  EXPECT_FALSE(model.materials.fit(model.grid));
  EXPECT_FALSE(RollingProblem<3>::create(model));
}

/// Where rows are unequal every one is divided, so that all are finer.
TEST(Layers, EndOnLinesOfFinerGridsOfUnequalRows) {
  const auto expect_finer = [](auto model, int least) {
    model.grid = with_lines_at(model.grid, model.materials.interfaces());
    const auto finer = on_finer_grid(model);
    EXPECT_TRUE(finer.materials.fit(finer.grid));
    EXPECT_GE(refinement(model.grid, finer.grid), 4.0 / 3 - 1e-12);
    EXPECT_LE(finer.grid.cells[0], 2 * model.grid.cells[0]);
    EXPECT_GE(finer.grid.cells[0], least);
    for (int row = 0; row < model.grid.cells[0]; ++row)
      EXPECT_LT(finer.grid.row_height(finer.grid.row_at(model.grid.middle_of_row(row))),
                0.76 * model.grid.row_height(row));
    const auto [line, distance] =
        finer.grid.nearest_line(model.grid.radius(model.grid.cells[0] - model.tread.rows));
    EXPECT_EQ(finer.grid.cells[0] - line, finer.tread.rows);
    EXPECT_NEAR(distance, 0, 1e-15);
  };
  RollingModel<2> plane;
  plane.grid = {0.20, 0.34, 0.12, 16, {14, 6}};
  plane.materials = layered<2>({{0.2337, {200e6, 0.3}}, {0.2412, {10e6, 0.3}}, {0.34, {200e6, 0.3}}});
  plane.tread = {2, 0, 3};
  expect_finer(plane, 28);
  RollingModel<3> solid;
  solid.grid = {0.20, 0.34, 0.12, 16, {14, 6, 4}};
  solid.materials = layered<3>({{0.2337, {200e6, 0.3}}, {0.2412, {10e6, 0.3}}, {0.34, {200e6, 0.3}}});
  solid.tread = {2, 0, 3};
  expect_finer(solid, 19);
}

/// The response of a stiff band on a soft layer does not decay within half the ring: a band and its bed must
/// not be condensed together.
TEST(Layers, AreNotCondensedTogetherAtTheTread) {
  auto model = paper_model(14, 192);
  model.materials = layered<2>({{0.33, {2e6, 0.3}}, {0.34, {200e9, 0.3}}});
  EXPECT_TRUE(RollingProblem<2>::create(model));
  model.tread.rows = 2;
  EXPECT_FALSE(RollingProblem<2>::create(model));
}

/// So do those of a model whose condensed rows are of unequal height.
TEST(Layers, AreNotCondensedWithRowsOfUnequalHeight) {
  auto model = paper_model(14, 192);
  model.grid = with_lines_at(model.grid, {0.3317});
  EXPECT_TRUE(RollingProblem<2>::create(model));
  model.tread.rows = 2;
  EXPECT_FALSE(RollingProblem<2>::create(model));
}

CaseResult layered_case(const std::string& layers, const std::string& more = "") {
  return parse_case("[wheel]\ninner_radius = 0.05\nouter_radius = 0.1\nwidth = 0.05\n[load]\nforce = 2000\n" +
                        layers + more,
                    "caster.toml");
}

TEST(Layers, OfACaseFillTheRing) {
  const auto good = layered_case(
      "[[material.layer]]\nname = \"tyre\"\ninner_radius = 0.09\nyoungs_modulus = 30e6\npoissons_ratio = "
      "0.48\n"
      "[[material.layer]]\nouter_radius = 0.06\nyoungs_modulus = 70e9\npoissons_ratio = 0.33\nholes = "
      "\"none\"\n");
  ASSERT_TRUE(good.value) << good.problems.front().text();
  const auto ring = placed_materials(*good.value);
  ASSERT_EQ(ring.size(), 3u);
  EXPECT_EQ(ring[0].youngs_modulus(), 70e9);
  EXPECT_FALSE(ring[1].layer);
  EXPECT_EQ(ring[1].outer_radius, 0.09);
  EXPECT_EQ(tread_material(*good.value).youngs_modulus(), 30e6);
  // Layers end on lines of the grid.
  EXPECT_TRUE(materials<2>(*good.value).fit(polar_grid<2>(*good.value)));
  EXPECT_GE(bands(*good.value).rim.thickness, 0.01 - 1e-12);
  // A thin layer on a stiff core is stiffer than a body of its material, and the patch is smaller.
  EXPECT_GT(effective_contact_modulus(*good.value), tread_material(*good.value).contact_modulus());
}

/// The rows of the grid move to the radii of layers and of the annulus, on all grids of a run.
TEST(Layers, OfACaseNeedNotFitTheGrid) {
  const std::string layers =
      "[[material.layer]]\ninner_radius = 0.0612\nouter_radius = 0.0787\nyoungs_modulus = "
      "30e6\npoissons_ratio = "
      "0.4\n[[material.layer]]\ninner_radius = 0.0917\nyoungs_modulus = 30e6\npoissons_ratio = 0.4\n";
  for (const std::string& more :
       {std::string(), std::string("[grid]\nradial_cells = 20\n[optimizer]\ntread_band = 0.006\n"),
        std::string("[grid]\nradial_cells = 20\n[optimizer]\ntread_band = 0.006\ncoarse_levels = 1\n"),
        std::string(
            "[objective]\nuniformity_annulus = 1\nannulus = 0.0043\n[optimizer]\ntread_band = 0.008\n")}) {
    SCOPED_TRACE(more);
    const auto result = layered_case(layers, more);
    ASSERT_TRUE(result.value) << result.problems.front().text();
    for (int level = 0; level <= result.value->optimizer.coarse_levels; ++level) {
      const Case c = on_coarser_grid(*result.value, level);
      const PolarGrid<2> grid = polar_grid<2>(c);
      EXPECT_EQ(grid.cells[0], c.grid.radial_cells);
      EXPECT_EQ(grid.n_sectors, c.wheel.sectors);
      for (const double radius : {0.0612, 0.0787, 0.0917})
        EXPECT_NEAR(grid.nearest_line(radius).distance, 0, 1e-15);
      EXPECT_TRUE(RollingProblem<2>::create(rolling_model<2>(c)));
      if (wants_annulus(c)) {
        EXPECT_NEAR(grid.height_of_rows(grid.cells[0] - tread_rows(c), grid.cells[0]), 0.0043, 1e-12);
      }
    }
  }
  const auto problems = layered_case(layers, "[grid]\nradial_cells = 3\n").problems;
  EXPECT_TRUE(std::ranges::any_of(
      problems, [](const Diagnostic& problem) { return problem.key == "grid.radial_cells"; }));
}

/// A row beside a thin layer is named, and a number of rows with which it is not.
TEST(Layers, ThatAreThinGetAWarning) {
  const auto of = [](int rows) {
    const auto result = layered_case(
        "[[material.layer]]\nname = \"foil\"\ninner_radius = 0.08\nouter_radius = 0.0803\nyoungs_modulus = "
        "30e6\npoissons_ratio = 0.4\n",
        "[optimizer]\ntread_band = 0.006\n[grid]\nradial_cells = " + std::to_string(rows) + "\n");
    EXPECT_TRUE(result.value) << result.problems.front().text();
    for (const std::string& warning : warnings(*result.value))
      if (warning.find("foil") != std::string::npos) return warning;
    return std::string();
  };
  const std::string warning = of(20), text = "grid.radial_cells = ";
  ASSERT_NE(warning.find(text), std::string::npos) << warning;
  EXPECT_EQ(of(std::stoi(warning.substr(warning.find(text) + text.size()))), "");
}

/// Neighbours without holes are one band, up to the tread: no edge of a band lies between them.
TEST(Layers, WithoutHolesAreBands) {
  const std::string constants = "youngs_modulus = 30e6\npoissons_ratio = 0.4\nholes = \"none\"\n",
                    layer = "[[material.layer]]\n" + constants;
  const auto of = [&](const std::string& layers) {
    const auto result = layered_case(layers);
    EXPECT_TRUE(result.value) << result.problems.front().text();
    return bands(*result.value);
  };
  const Bands at_tread =
      of(layer + "inner_radius = 0.08\nouter_radius = 0.09\n" + layer + "inner_radius = 0.09\n");
  EXPECT_NEAR(at_tread.tread.thickness, 0.02, 1e-12);
  EXPECT_TRUE(at_tread.between.empty());
  const Bands between = of(layer + "inner_radius = 0.07\nouter_radius = 0.08\n");
  ASSERT_EQ(between.between.size(), 1u);
  EXPECT_EQ(between.between[0].inner, 0.07);
  EXPECT_EQ(between.between[0].outer, 0.08);
}

/// A drawn hole across a layer without holes ends at it, and no shape of a run opens it.
TEST(Layers, WithoutHolesStaySolid) {
  const auto good = parse_case(
      "[wheel]\ninner_radius = 0.05\nouter_radius = 0.1\nwidth = 0.05\nsectors = 8\n[load]\nforce = 500\n"
      "[material]\nyoungs_modulus = 60e6\n[[material.layer]]\ninner_radius = 0.07\nouter_radius = 0.08\n"
      "youngs_modulus = 900e6\npoissons_ratio = 0.4\nholes = \"none\"\n[[holes.ring]]\ncount = 8\n"
      "center_radius = 0.075\nradius = 0.012\n[grid]\nradial_cells = 20\nangular_cells = 160\n"
      "[optimizer]\niterations = 5\ntread_band = 0.005\n",
      "layer.toml");
  ASSERT_TRUE(good.value) << good.problems.front().text();
  EXPECT_TRUE(std::ranges::any_of(warnings(*good.value), [](const std::string& warning) {
    return warning.starts_with("holes reach into layer 1");
  }));
  EXPECT_TRUE(lost_on_the_grid<2>(*good.value).empty());
  const auto study = make_study<2>(*good.value);
  ASSERT_TRUE(study);
  const auto optimizer = optimizer_of(*study);
  auto state = optimizer.start(study->initial, [](const auto&, const auto&) {});
  ASSERT_TRUE(state) << state.failure().detail;
  const double before = state->evaluation.function("objective").value;
  optimizer.run(
      *state, [](const auto&, const auto&) {}, [] { return false; });
  EXPECT_LT(state->evaluation.function("objective").value, before);
  const LevelSet<2>& shape = state->shape;
  for (int node = 0; node < shape.lattice.n_nodes(); ++node) {
    const double radius = shape.lattice.polar_point(node)[0];
    if (radius < 0.07 - 1e-9 || radius > 0.08 + 1e-9) continue;
    EXPECT_LT(shape.values[node], 0) << radius;
  }
}

/// Holes of a saved shape in a layer at the rim that has none are not lost on the grid.
TEST(Layers, WithoutHolesAtTheRimDoNotBlameTheGrid) {
  const auto open = layered_case(
      "",
      "[[holes.ring]]\ncount = 16\ncenter_radius = 0.0625\nradius = 0.005\n[[holes.ring]]\ncount = 16\n"
      "center_radius = 0.08\nradius = 0.006\n");
  auto solid = layered_case(
      "[[material.layer]]\nouter_radius = 0.07\nyoungs_modulus = 9e8\npoissons_ratio = 0.4\nholes = "
      "\"none\"\n");
  ASSERT_TRUE(open.value && solid.value);
  Case& c = *solid.value;
  c.saved_shape.shape.contents = std::make_shared<SavedLevelSet>(initial_shape<2>(*open.value));
  EXPECT_TRUE(lost_on_the_grid<2>(c).empty());
  EXPECT_EQ(components(initial_shape<2>(c)).all.size(), 2u);  // the material and a hole
}

double length(const std::vector<Vec<2>>& points, const std::vector<std::uint32_t>& pairs) {
  double sum = 0;
  for (std::size_t k = 0; k < pairs.size(); k += 2) sum += distance(points[pairs[k]], points[pairs[k + 1]]);
  return sum;
}

/// Pictures draw the edges of a mesh on the circle between two layers, as far as there is material.
TEST(Layers, MeetAtTheEdgesThatPicturesDraw) {
  auto model = paper_model(14, 192);
  model.materials = layered<2>({{0.27, {200e6, 0.3}}, {0.34, {10e6, 0.45}}});
  const SectorMesh whole = sector_mesh(full(model.grid), model);
  EXPECT_NEAR(length(whole.points, whole.layer_edges) * model.grid.n_sectors / (2 * pi * 0.27), 1, 1e-3);
  const SectorMesh mesh = sector_mesh(generic_hole(model.grid), model);
  EXPECT_GT(length(mesh.points, mesh.layer_edges), 0);
  EXPECT_LT(length(mesh.points, mesh.layer_edges), 0.9 * length(whole.points, whole.layer_edges));
  for (const std::uint32_t end : mesh.layer_edges) {
    EXPECT_NEAR(norm(mesh.points[end]), 0.27, 1e-5);
    EXPECT_EQ(mesh.rows[end], 6);
  }
}

/// A surface has separate vertices for the layers, so that fields jump, and lines around both side faces.
TEST(Layers, HaveSeparateVerticesOnSurfaces) {
  const PolarGrid<3> grid{0.20, 0.34, 0.12, 8, {14, 12, 4}};
  const LevelSet<3> psi = [&] {
    LevelSet<3> ring{Lattice<3>(grid, 1), {}};
    ring.values.assign(ring.lattice.n_nodes(), -0.01);
    return ring;
  }();
  const SurfaceMesh mesh = material_surface(psi, 2, 2);
  const LayeredSurface layered = layered_surface(mesh, grid, {0.27});
  EXPECT_EQ(layered.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(enclosed_volume(layered), enclosed_volume(mesh), 1e-15);
  EXPECT_EQ(layered.points.size(), mesh.points.size() + 8 * 2 * 24);  // the vertices on two circles
  double sum = 0;
  for (const auto& [a, b] : layered.layer_edges) {
    sum += norm<3>(layered.points[b] - layered.points[a]);
    EXPECT_NEAR(std::hypot(layered.points[a][0], layered.points[a][1]), 0.27, 1e-4);
  }
  EXPECT_NEAR(sum / (2 * 2 * pi * 0.27), 1, 1e-3);
  for (const auto& triangle : layered.triangles) {
    int inside = 0, outside = 0;
    for (const int vertex : triangle) {
      const CellPoint& place = layered.places[vertex % layered.sector_points()];
      inside += place.cell[0] < 7;
      outside += place.cell[0] >= 7;
    }
    EXPECT_TRUE(inside == 0 || outside == 0);
  }
}

/// The parts of a shape make up the whole, also where a hole crosses from one to another.
TEST(Layers, AreShapesOfTheirOwn) {
  const auto result = layered_case(
      "[[material.layer]]\nname = \"band\"\ninner_radius = 0.07\nouter_radius = 0.08\nyoungs_modulus = 9e6\n"
      "poissons_ratio = 0.4\n",
      "[[holes.circle]]\ncenter = [0.07, 0.01]\nradius = 0.006\n[optimizer]\ntread_band = 0.005\n");
  ASSERT_TRUE(result.value) << result.problems.front().text();
  const LevelSet<2> whole = initial_shape<2>(*result.value);
  const auto parts = layer_shapes(*result.value, whole);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].name, "material");
  EXPECT_EQ(parts[1].name, "band");
  EXPECT_EQ(parts[2].name, "material 2");
  EXPECT_NEAR(parts[1].shape.lattice.grid().inner_radius, 0.07, 1e-15);
  double sum = 0;
  for (const LayerShape<2>& part : parts) sum += material_measure(part.shape);
  EXPECT_NEAR(sum / material_measure(whole), 1, 1e-12);
  EXPECT_LT(material_measure(parts[1].shape), sector_measure<2>(parts[1].shape.lattice.grid()));
}

/// Holes end a thousandth of a cell before a layer without holes, which would leave a skin beside it.
TEST(Layers, AreCutOnTheSideOfTheHolesThatEndAtThem) {
  const auto result = parse_case(
      "[wheel]\ninner_radius = 0.05\nouter_radius = 0.1\nwidth = 0.05\nsectors = 8\n[load]\nforce = 500\n"
      "[material]\nyoungs_modulus = 60e6\n[[material.layer]]\nouter_radius = 0.06\nyoungs_modulus = 9e8\n"
      "poissons_ratio = 0.4\n[[material.layer]]\ninner_radius = 0.07\nouter_radius = 0.08\n"
      "youngs_modulus = 900e6\npoissons_ratio = 0.4\nholes = \"none\"\n[[holes.ring]]\ncount = 8\n"
      "center_radius = 0.075\nradius = 0.012\n[grid]\nradial_cells = 20\nangular_cells = 160\n"
      "[optimizer]\ntread_band = 0.005\n",
      "layer.toml");
  ASSERT_TRUE(result.value) << result.problems.front().text();
  constexpr double tolerance = 1e-5;
  const double apart = 0.001 * polar_grid<2>(*result.value).resolution() + 2 * tolerance;
  const auto radii = cutting_radii(*result.value, tolerance);
  ASSERT_EQ(radii.size(), 3u);
  EXPECT_NEAR(radii[0], 0.06, 1e-15);
  EXPECT_NEAR(radii[1], 0.07 - apart, 1e-15);
  EXPECT_NEAR(radii[2], 0.08 + apart, 1e-15);
  const auto whole = cad::fit_outline(initial_shape<2>(*result.value), tolerance);
  ASSERT_TRUE(whole) << whole.failure().what;
  const auto parts = cad::cut_by_circles(*whole, radii);
  ASSERT_TRUE(parts) << parts.failure().what;
  double sum = 0;
  for (const cad::Outline& part : *parts) {
    EXPECT_TRUE(cad::crossing_faults(part, tolerance).empty());
    sum += cad::material_area(part);
  }
  EXPECT_NEAR(sum / cad::material_area(*whole), 1, 1e-12);
  // Not cut there, the holes leave skins beside the layer.
  const auto with_skins = cad::cut_by_circles(*whole, {0.06, 0.07, 0.08});
  ASSERT_TRUE(with_skins);
  EXPECT_FALSE(cad::crossing_faults((*with_skins)[1], tolerance).empty());
}

TEST(Layers, AreNamedByBoundsTermsAndExpectations) {
  const std::string tyre =
      "[[material.layer]]\nname = \"tyre\"\ninner_radius = 0.09\nyoungs_modulus = 9e6\n"
      "poissons_ratio = 0.4\ndensity = 1100\n";
  const auto good =
      layered_case(tyre,
                   "[[constraint]]\nquantity = \"peak_von_mises\"\nlayer = \"tyre\"\nat_most = 3e5\n"
                   "[[constraint]]\nquantity = \"peak_von_mises\"\nlayer = \"material\"\nat_least = 4e5\n"
                   "[[objective.term]]\nquantity = \"mass\"\nlayer = \"tyre\"\nweight = 2\n");
  ASSERT_TRUE(good.value) << good.problems.front().text();
  const Case& c = *good.value;
  EXPECT_EQ(name(quantity_of(c, c.constraints[0])), "peak_von_mises of tyre");
  EXPECT_FALSE(quantity_of(c, c.constraints[0]) == quantity_of(c, c.constraints[1]));
  const Quantity mass = quantity_of(c, c.objective.terms[0]);
  EXPECT_EQ(number_key(mass, 2), "mass_kg of tyre");
  EXPECT_EQ(number_key(built_in("peak_temperature"), 2), "peak_temperature_deg_C");
  EXPECT_EQ(mass->part->inner, 0.09);
  EXPECT_FALSE(holds_volume(c));

  const auto refuses = [&](const std::string& table, const std::string& key) {
    const auto result = layered_case(tyre, table);
    EXPECT_FALSE(result.value) << table;
    if (result.problems.empty()) return std::string();
    EXPECT_EQ(result.problems.front().key, key) << result.problems.front().text();
    return result.problems.front().text();
  };
  const auto bound = [](const std::string& quantity, const std::string& layer) {
    return "[[constraint]]\nquantity = \"" + quantity + "\"\nlayer = \"" + layer + "\"\nat_most = 3\n";
  };
  const std::string text = refuses(bound("peak_von_mises", "tyer"), "constraint[1].layer");
  EXPECT_NE(text.find("material, tyre"), std::string::npos) << text;
  refuses(bound("stiffness", "tyre"), "constraint[1].layer");
  refuses(bound("mass", "material"), "constraint[1].quantity");  // without a density
  refuses(bound("peak_von_mises", "tyre") +
              "[[constraint]]\nquantity = \"peak_von_mises\"\nlayer = \"tyre\"\nat_least = 4\n",
          "constraint[2].at_least");
  refuses("[objective]\nlayer = \"tyre\"\n", "objective.layer");
  refuses("[[expect]]\nquantity = \"largest_strain\"\nlayer = \"tire\"\nvalue = 1\n", "expect[1].layer");
}

TEST(Layers, ThatCannotBeAreRefusedByKey) {
  const auto refuses = [](const std::string& layers, const std::string& key) {
    const auto result = layered_case(layers);
    EXPECT_FALSE(result.value) << layers;
    ASSERT_FALSE(result.problems.empty());
    EXPECT_EQ(result.problems.front().key, key) << result.problems.front().text();
  };
  const std::string constants = "youngs_modulus = 30e6\npoissons_ratio = 0.4\n",
                    layer = "[[material.layer]]\n" + constants;
  refuses(layer + "inner_radius = 0.09\nouter_radius = 0.08\n", "material.layer[1].outer_radius");
  refuses(layer + "outer_radius = 0.2\n", "material.layer[1].outer_radius");
  refuses(layer + layer, "material.layer[2]");
  refuses(layer + "name = \"my tyre\"\ninner_radius = 0.09\n", "material.layer[1].name");
  refuses(layer + "name = \"material\"\ninner_radius = 0.09\n", "material.layer[1].name");
  refuses(layer + "name = \"a\"\ninner_radius = 0.09\n" + layer + "name = \"a\"\nouter_radius = 0.06\n",
          "material.layer[2].name");
  refuses("[[material.layer]]\ninner_radius = 0.09\npoissons_ratio = 0.4\n",
          "material.layer[1].youngs_modulus");
  refuses("[[material.layer]]\ninner_radius = 0.09\nyoungs_modulus = 3e6\npoissons_ratio = 0.499995\n",
          "material.layer[1].poissons_ratio");
  refuses(layer + "inner_radius = 0.09\n[objective]\nminimize = \"mass\"\n", "objective.minimize");
  const auto contrast = layered_case(
      "[[material.layer]]\nname = \"hub\"\nouter_radius = 0.06\nyoungs_modulus = 1e12\npoissons_ratio = 0.3\n"
      "[[material.layer]]\ninner_radius = 0.07\nouter_radius = 0.08\nyoungs_modulus = 1e2\npoissons_ratio = "
      "0.3\n");
  EXPECT_TRUE(std::ranges::any_of(contrast.problems, [](const Diagnostic& problem) {
    return problem.key == "material.layer[1].youngs_modulus" &&
           problem.text().find("hub is 1e+10 times as stiff as layer 2") != std::string::npos;
  }));
}

}  // namespace
}  // namespace wheelwright
