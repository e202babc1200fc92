#include "wheelwright/shape/geometry/mirror.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support.h"
#include "wheelwright/quantities/functionals/mean_contact_stress.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using testing::generic_hole;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;

/// Two holes that are each other's mirror image and one that is its own.
LevelSet<2> symmetric_holes(const PolarGrid<2>& grid) {
  const double a = grid.sector_angle();
  return holes(grid, 2, {{0.2312, 0.22 * a, 0.0113}, {0.2312, 0.78 * a, 0.0113}, {0.281, 0.5 * a, 0.0317}});
}

/// The shape derivative for some movements of the boundary, most of them not symmetric.
template <int dim>
std::vector<double> derivatives(const PolarGrid<dim>& grid, const std::vector<SurfaceSample<dim>>& gradient) {
  std::vector<double> result;
  for (int k = 0; k < 6; ++k) {
    double sum = 0;
    for (const auto& sample : gradient) {
      const auto cell = grid.cell_position(sample.cell);
      const double radial = (cell[0] + sample.xi[0]) / grid.cells[0],
                   azimuth = (cell[1] + sample.xi[1]) / grid.columns();
      const Vec<dim> movement{std::cos(2 * k * azimuth - k), std::sin(7 * radial + k * azimuth)};
      sum += sample.weight * sample.value * dot<dim>(movement, sample.normal);
    }
    result.push_back(sum);
  }
  return result;
}

/// Expects of a shape's distinct positions what all of them give. Not to rounding: the quadrature of a cut
/// cell is not the mirror image of that of its image.
template <int dim>
void expect_the_same_of_all(const RollingModel<dim>& model, const WeightedSum<dim>& objective,
                            const LevelSet<dim>& psi, int n_distinct) {
  const auto problem = RollingProblem<dim>::create(model);
  ASSERT_TRUE(problem);
  const auto all = testing::all_states<dim>(*problem, psi);
  ASSERT_TRUE(all) << all.failure().detail;
  const ShapeFunction<dim> function = wheelwright::objective(objective);
  const auto expected = differentiate<dim>(*problem, std::span(&function, 1), psi, **all);
  const auto found = testing::evaluate_objective<dim>(*problem, objective, psi);
  ASSERT_TRUE(expected);
  ASSERT_TRUE(found);
  EXPECT_EQ(expected->newton_iterations.size(), model.n_positions);
  EXPECT_EQ(found->newton_iterations.size(), n_distinct);
  const FunctionValue &found_value = found->function("objective"),
                      &expected_value = expected->function("objective");
  EXPECT_NEAR(found_value.value, expected_value.value, 1e-8 * expected_value.value);
  ASSERT_EQ(found_value.by_position.size(), model.n_positions);
  for (int i = 0; i < model.n_positions; ++i)
    EXPECT_NEAR(found_value.by_position[i], expected_value.by_position[i], 1e-8 * expected_value.value);
  for (size_t k = 0; k < objective.size(); ++k)
    EXPECT_NEAR(found->terms[k].value, expected->terms[k].value, 1e-8 * expected->terms[k].value)
        << found->terms[k].name;
  for (size_t k = 0; k < expected->measures.size(); ++k)
    EXPECT_NEAR(found->measures[k].value, expected->measures[k].value,
                1e-7 * std::abs(expected->measures[0].value + expected->measures[k].value));
  EXPECT_LT(testing::relative_difference(
                {found->mean_observations.entries().begin(), found->mean_observations.entries().end()},
                {expected->mean_observations.entries().begin(), expected->mean_observations.entries().end()}),
            1e-7);
  EXPECT_LT(testing::relative_difference(derivatives<dim>(model.grid, found->gradient("objective")),
                                         derivatives<dim>(model.grid, expected->gradient("objective"))),
            1e-6);
}

WeightedSum<2> all_functionals(const RollingModel<2>& model) {
  auto image = RollingProblem<2>::create(model)->neumann_to_dirichlet(DualNorm::elasticity);
  EXPECT_TRUE(image);
  return {{1, std::make_shared<StrainEnergy<2>>()},
          {10, std::make_shared<UniformityL2<2>>(0.01)},
          {10, std::make_shared<UniformityAnnulus<2>>(0.01)},
          {10, std::make_shared<UniformityDual<2>>(*std::move(image))}};
}

TEST(MirrorSymmetry, AShapeIsItsOwnImageOrNot) {
  const PolarGrid<2> grid = paper_model(14, 192).grid;
  EXPECT_TRUE(is_mirror_symmetric(paper_holes(grid)));
  EXPECT_TRUE(is_mirror_symmetric(symmetric_holes(grid)));
  EXPECT_FALSE(is_mirror_symmetric(generic_hole(grid)));
  auto off = paper_holes(grid);
  off.values[off.lattice.n_nodes() / 3] += 1e-8 * grid.resolution();
  EXPECT_FALSE(is_mirror_symmetric(off));
  off.values[off.lattice.n_nodes() / 3] = NAN;
  EXPECT_FALSE(is_mirror_symmetric(off));
}

TEST(MirrorSymmetry, ACellsImageIsInTheSameSectorAndItsImageIsTheCell) {
  const PolarGrid<3> grid{0.2, 0.34, 0.12, 5, {4, 7, 3}};
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const int image = mirror_image(grid, cell);
    EXPECT_EQ(mirror_image(grid, image), cell);
    EXPECT_EQ(grid.cell_position(cell)[1] + grid.cell_position(image)[1], 6);
    EXPECT_EQ(grid.cell_position(cell)[0], grid.cell_position(image)[0]);
    EXPECT_EQ(grid.cell_position(cell)[2], grid.cell_position(image)[2]);
  }
}

TEST(MirrorSymmetry, PositionsWithoutImagesStandForAll) {
  const PolarGrid<2> grid = paper_model(14, 192).grid;
  for (int n = 1; n <= 12; ++n) {
    const LoadPositions all = load_positions(grid, n), distinct = load_positions_without_images(grid, n);
    std::vector<double> reached;
    for (int i = 0; i < distinct.size(); ++i) {
      const double azimuth = distinct.grounds[i].azimuth(grid);
      reached.push_back(azimuth);
      if (distinct.multiplicities[i] == 2) reached.push_back(grid.sector_angle() - azimuth);
    }
    std::sort(reached.begin(), reached.end());
    ASSERT_EQ(reached.size(), n);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(reached[i], all.grounds[i].azimuth(grid), 1e-15);
  }
}

TEST(MirrorSymmetry, HalfOfThePositionsGiveAllFunctionalsAndTheirGradient) {
  for (const int levels : {0, 2}) {
    auto model = paper_model(14, 192);
    model.tread = {1, levels, 3};
    model.n_positions = 4;
    expect_the_same_of_all(model, all_functionals(model), symmetric_holes(model.grid), 3);
  }
}

// A column in the middle of the sector is its own image, and no position is there.
TEST(MirrorSymmetry, OddNumbersOfColumnsAndPositions) {
  auto model = paper_model(14, 16 * 15);
  model.tread = {1, 1, 3};
  model.n_positions = 5;
  expect_the_same_of_all(model, all_functionals(model), symmetric_holes(model.grid), 3);
}

// With 8 positions on 12 columns, points of the tread meet the edges of its faces.
TEST(MirrorSymmetry, PositionsBetweenColumns) {
  for (const int n : {7, 8})
    for (const int levels : {0, 1}) {
      auto model = paper_model(14, 192);
      model.tread = {1, levels, 3};
      model.n_positions = n;
      expect_the_same_of_all(model, all_functionals(model), symmetric_holes(model.grid), n / 2 + 1);
    }
}

TEST(MirrorSymmetry, WithFrictionBodyForceAndPressure) {
  auto model = paper_model(14, 192);
  model.contact.friction = 0.4;
  model.distributed = {{4e4, 0}, 2e4};
  expect_the_same_of_all(model, testing::strain_energy_alone(), symmetric_holes(model.grid), 5);
}

TEST(MirrorSymmetry, In3D) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 6, 2}};
  model.degree = 1;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.n_positions = 4;
  model.contact_points = 3;
  const Circle hole{0.26, 0.5 * model.grid.sector_angle(), 0.03};
  auto psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    psi.values[i] += 0.002 * std::cos(20 * psi.lattice.polar_point(i)[2]);
  expect_the_same_of_all<3>(model, {{1, std::make_shared<StrainEnergy<3>>()}}, psi, 3);
}

// The density is that of the problem that is solved: shape and direction are symmetric here.
TEST(MirrorSymmetry, GradientPassesTheTaylorTest) {
  auto model = paper_model(14, 192);
  model.tread = {1, 1, 3};
  model.n_positions = 4;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto objective = all_functionals(model);
  const auto psi = holes(model.grid, 2, {{0.2681, 0.5 * model.grid.sector_angle(), 0.0373}});
  const auto test = taylor_test<2>(
      [&](const LevelSet<2>& shape) { return testing::evaluate_objective<2>(*problem, objective, shape); },
      psi, testing::smooth_direction(psi.lattice), model.degree, 2e-5, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  for (const double order : test->orders) EXPECT_GT(order, 1.9);
}

TEST(MirrorSymmetry, EvolutionKeepsIt) {
  const auto model = paper_model(14, 192);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  auto psi = symmetric_holes(model.grid);
  const double row = model.grid.row_height(0);
  const Evolver<2> evolver(
      psi.lattice, {.velocity = {}, .smoothing = 0.1, .bands = {.rim = {row, 1}, .tread = {2 * row, 2}}});
  for (int shape = 0; shape < 5; ++shape) {
    const auto evaluation = testing::evaluate_objective<2>(*problem, testing::strain_energy_alone(), psi);
    ASSERT_TRUE(evaluation);
    EXPECT_EQ(evaluation->newton_iterations.size(), 5);
    auto velocity = *evolver.measure_preserving_velocity(evaluation->gradient("objective"));
    const auto moved = *evolver.move(psi, velocity, row / 2);
    EXPECT_TRUE(is_mirror_symmetric(moved));
    const auto redistanced = *evolver.redistance(moved);
    EXPECT_TRUE(is_mirror_symmetric(redistanced));
    const auto smooth = *evolver.smooth(redistanced);
    EXPECT_TRUE(is_mirror_symmetric(smooth));

    velocity[psi.lattice.node_index({14, 6})] += 0.01;
    EXPECT_FALSE(is_mirror_symmetric(*evolver.move(psi, velocity, row / 2)));
    psi = smooth;
  }
}

TEST(MirrorSymmetry, LoadsOrShapesThatAreNotSymmetricNeedAllPositions) {
  const auto model = paper_model(14, 192);
  const auto n_solved = [](const RollingModel<2>& m, const LevelSet<2>& psi) {
    const auto problem = RollingProblem<2>::create(m);
    return problem->distinct_positions(psi).size();
  };
  const auto psi = paper_holes(model.grid);
  EXPECT_EQ(n_solved(model, psi), 5);
  EXPECT_EQ(n_solved(model, generic_hole(model.grid)), 8);
  auto pushed = model;
  pushed.contact.friction = 0.5;
  pushed.horizontal_force = 100;
  EXPECT_EQ(n_solved(pushed, psi), 8);
  pushed.horizontal_force = 0;
  EXPECT_EQ(n_solved(pushed, psi), 5);
  pushed.torque = 10;
  EXPECT_EQ(n_solved(pushed, psi), 8);
  auto on_columns = model;
  on_columns.n_positions = 4;
  const auto problem = RollingProblem<2>::create(on_columns);
  const auto mean_of = [&](const LevelSet<2>& shape) {
    return mean_observations(problem->tread_surface(), **testing::all_states<2>(*problem, shape));
  };
  const Matrix own = mean_of(psi), other = mean_of(generic_hole(model.grid));
  for (const auto& [mean, n] : {std::pair{&own, 3}, {&other, 4}})
    EXPECT_EQ(testing::evaluate_objective<2>(*problem, testing::strain_energy_alone(), psi, mean)
                  ->newton_iterations.size(),
              n);
  auto braking = model;
  braking.distributed.body_force = {0, 1e3};
  EXPECT_EQ(n_solved(braking, psi), 8);
}

}  // namespace
}  // namespace wheelwright
