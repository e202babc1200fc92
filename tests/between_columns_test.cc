#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support.h"
#include "wheelwright/quantities/functionals/column_shift.h"
#include "wheelwright/quantities/functionals/mean_contact_stress.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

using testing::all_states;
using testing::evaluate_objective;
using testing::generic_hole;
using testing::paper_model;
using testing::relative_difference;
using testing::value_of;

/// 12 columns per sector.
RollingModel<2> model_with(int n_positions, int levels = 1, int rows = 1) {
  auto model = paper_model(14, 192);
  model.tread = {rows, levels, 3};
  model.n_positions = n_positions;
  return model;
}

WeightedSum<2> uniformity_functionals(const StateSolver<2>& solver) {
  auto image = solver.neumann_to_dirichlet(DualNorm::elasticity);
  EXPECT_TRUE(image);
  return {{1, std::make_shared<UniformityL2<2>>(0.01)},
          {1, std::make_shared<UniformityAnnulus<2>>(0.01)},
          {1, std::make_shared<UniformityDual<2>>(*std::move(image))}};
}

/// The azimuth of every observation but the last in its column, from the faces' Gauss points [columns]; NaN
/// where no line of points holds the observation.
std::vector<double> places(const TreadSurface<2>& tread) {
  std::vector<double> places(tread.rows().size() / 2 - 1, NAN);
  for (const FaceRow& row : tread.face_rows)
    for (int face = 0; face < row.faces; ++face)
      for (int a = 0; a < row.points_per_face; ++a) {
        double& place = places[row.observation(face, a)];
        EXPECT_TRUE(std::isnan(place));  // no two lines hold the same
        place = (face + gauss_rule(row.points_per_face).points[a]) / row.faces;
      }
  return places;
}

TEST(ColumnShift, LinesOfPointsHoldEveryObservationAtItsPlace) {
  for (const int levels : {0, 1, 2}) {
    const auto problem = RollingProblem<2>::create(model_with(8, levels, 2));
    const TreadSurface<2>& tread = problem->tread_surface();
    const double width = 2 * std::numbers::pi / tread.n_columns;
    const auto place = places(tread);
    for (size_t q = 0; q < tread.points.size(); ++q) {
      const Vec<2>& x = tread.points[q].position;
      for (const size_t k : {2 * q, 2 * q + 1})
        EXPECT_NEAR(place[k], std::atan2(x[1], x[0]) / width, levels == 0 ? 2e-4 : 1e-4);
    }
    // Images are where the mirror puts them, in the annulus too.
    for (size_t k = 0; k < place.size(); ++k) EXPECT_NEAR(place[tread.mirror_images[k]], 1 - place[k], 1e-12);
  }
}

/// A field round the ring as columns observe it at their points, each in its own frame.
std::vector<double> observed(const TreadSurface<2>& tread, double first_column,
                             const std::function<Vec<2>(double)>& field) {
  const double width = 2 * std::numbers::pi / tread.n_columns;
  std::vector<double> values;
  for (const double place : places(tread)) {
    const Vec<2> v = rotated<2>(field(first_column + place), -first_column * width);
    values.insert(values.end(), v.begin(), v.end());
  }
  values.resize(tread.rows().size(), 0.0);
  return values;
}

// Cubics on two columns: three points a face in the annulus hold quadratics, five on the tread quartics.
TEST(ColumnShift, IsExactForPolynomials) {
  for (const int levels : {0, 1, 2}) {
    const auto problem = RollingProblem<2>::create(model_with(8, levels, 2));
    const TreadSurface<2>& tread = problem->tread_surface();
    const auto quadratic = [](double x) { return Vec<2>{1 + x - 0.7 * x * x, -2 + 0.3 * x * x}; };
    const auto here = observed(tread, 0, quadratic), next = observed(tread, 1, quadratic);
    for (const double fraction : {0.0, 1e-3, 0.25, 1.0 / 3, 0.5, 0.75, 0.999}) {
      std::vector<double> shifted(here.size(), 0.0);
      ColumnShift<2>(tread, fraction).add(2, here.data(), next.data(), shifted.data());
      const auto expected = observed(tread, fraction, quadratic);
      for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(shifted[i], 2 * expected[i], 1e-12) << levels << ", " << fraction << ", " << i;
    }
  }
}

// A point between two faces: the middle one of five is there after half a column.
TEST(ColumnShift, TakesTheMeanBetweenFaces) {
  const auto problem = RollingProblem<2>::create(model_with(8, 0));
  const TreadSurface<2>& tread = problem->tread_surface();
  const auto step = [](double x) { return Vec<2>{x < 1 ? 2.0 : 6.0, 0}; };
  const auto here = observed(tread, 0, step), next = observed(tread, 1, step);
  std::vector<double> shifted(here.size(), 0.0);
  ColumnShift<2>(tread, 0.5).add(1, here.data(), next.data(), shifted.data());
  const double width = 2 * std::numbers::pi / tread.n_columns;
  const Vec<2> middle{shifted[tread.rows().traction(2)], shifted[tread.rows().traction(2) + 1]};
  EXPECT_NEAR(middle[0], 4 * std::cos(0.5 * width), 1e-12);
  EXPECT_NEAR(middle[1], -4 * std::sin(0.5 * width), 1e-12);
}

TEST(ColumnShift, ItsTransposeIsTheTranspose) {
  const auto problem = RollingProblem<2>::create(model_with(8, 1));
  const TreadSurface<2>& tread = problem->tread_surface();
  const int n = tread.rows().size();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto some = [&] {
    std::vector<double> x(n);
    for (double& value : x) value = uniform(random);
    return x;
  };
  for (const double fraction : {0.0, 0.3, 0.5}) {
    const ColumnShift<2> shift(tread, fraction);
    const auto column = some(), next = some(), load = some();
    std::vector<double> shifted(n), on_column(n), on_next(n);
    shift.add(0.7, column.data(), next.data(), shifted.data());
    shift.add_transposed(0.7, load.data(), on_column.data(), on_next.data());
    const auto dot = [](const auto& a, const auto& b) {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    EXPECT_NEAR(dot(load, shifted), dot(on_column, column) + dot(on_next, next), 1e-12);
  }
}

// Eight positions on twelve columns: half of them stand in the middle of a column.
TEST(BetweenColumns, GradientsPassTheTaylorTest) {
  for (const int n_positions : {8, 5}) {
    const auto problem = RollingProblem<2>::create(model_with(n_positions));
    ASSERT_TRUE(problem);
    ASSERT_FALSE(problem->all_positions().stand_on_columns());
    auto objective = uniformity_functionals(*problem);
    objective.push_back({1, std::make_shared<StrainEnergy<2>>()});
    for (const auto& term : objective) {
      const auto test = testing::generic_taylor_test(*problem, {term});
      ASSERT_TRUE(test) << test.failure().detail;
      for (const double order : test->orders) EXPECT_GT(order, 1.9) << term.functional->name();
    }
  }
}

TEST(BetweenColumns, FixedMeanPassesTheTaylorTest) {
  const auto problem = RollingProblem<2>::create(model_with(8));
  ASSERT_TRUE(problem);
  const auto psi = generic_hole(problem->model().grid);
  const auto earlier = all_states<2>(*problem, testing::paper_holes(problem->model().grid));
  ASSERT_TRUE(earlier);
  const Matrix held = mean_observations(problem->tread_surface(), **earlier);
  for (const auto& term : uniformity_functionals(*problem)) {
    const auto test = taylor_test<2>(
        [&](const LevelSet<2>& shape) { return evaluate_objective<2>(*problem, {term}, shape, &held); }, psi,
        testing::smooth_direction(psi.lattice), 2, 2e-5, 3);
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9) << term.functional->name();
  }
}

// The loads of J(x) = 1/2 sum |d|^2 on the deviations d are the deviations.
TEST(BetweenColumns, TheDerivativeOfTheMeanCounts) {
  const auto problem = RollingProblem<2>::create(model_with(8));
  ASSERT_TRUE(problem);
  const auto psi = generic_hole(problem->model().grid);
  const auto state = all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  const TreadSurface<2>& tread = problem->tread_surface();
  const LoadPositions& positions = (*state)->positions();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto noise = [&](const Matrix& like) {
    Matrix x(like.rows(), like.columns());
    for (double& value : x.entries()) value = uniform(random);
    return x;
  };
  const Matrix x = noise((*state)->observations()), dx = noise(x);
  const auto deviation = [&](const Matrix& observations) {
    return deviation_from_mean(tread, positions, observations,
                               mean_over_positions(tread, positions, observations));
  };
  const auto dot = [](const Matrix& a, const Matrix& b) {
    return std::inner_product(a.entries().begin(), a.entries().end(), b.entries().begin(), 0.0);
  };
  Matrix loads = deviation(x);
  const double expected = dot(deviation(x), deviation(dx));
  add_derivative_of_mean(tread, positions, loads);
  EXPECT_NEAR(dot(loads, dx), expected, 1e-12 * dot(x, x));
  EXPECT_GT(std::abs(dot(deviation(x), dx) - expected), 1e-6 * std::abs(expected));
}

// A ring without holes rolls evenly. Positions in the middle of a column see other points of the tread, so
// that its functionals are not zero but tend to zero with the cells.
TEST(BetweenColumns, AUniformRingTendsToBeUniform) {
  const auto values = [](DilatationKind dilatation, int refinement) {
    auto model = model_with(8 * refinement, 1, refinement);
    model.grid.cells = {14 * refinement, 12 * refinement};
    model.dilatation = dilatation;
    const auto problem = RollingProblem<2>::create(model);
    EXPECT_TRUE(problem);
    LevelSet<2> solid{Lattice<2>(model.grid, 2), {}};
    solid.values.assign(solid.lattice.n_nodes(), -1.0);
    const auto s = all_states<2>(*problem, solid);
    EXPECT_TRUE(s);
    const Matrix mean = mean_observations(problem->tread_surface(), **s);
    std::vector<double> result;
    for (const auto& term : uniformity_functionals(*problem))
      result.push_back(value_of<2>(*term.functional, *problem, solid, **s, mean) / model.n_positions);
    return result;
  };
  // A projected pressure is of lower order.
  for (const auto& [dilatation, order] :
       {std::pair{DilatationKind::pointwise, 4}, {DilatationKind::projected, 3}}) {
    const auto coarse = values(dilatation, 1), fine = values(dilatation, 2);
    for (size_t k = 0; k < coarse.size(); ++k) EXPECT_GT(std::log2(coarse[k] / fine[k]), order) << k;
  }
}

// The same wheel on a grid whose columns the positions do meet.
TEST(BetweenColumns, TheDualNormIsThatOfAGridThatFits) {
  const auto dual_of = [](int angular_cells) {
    auto model = model_with(8, 3);
    model.grid.cells[1] = angular_cells / 16;
    const auto problem = RollingProblem<2>::create(model);
    EXPECT_TRUE(problem);
    const LevelSet<2> psi = testing::paper_holes(model.grid);
    const auto s = all_states<2>(*problem, psi);
    EXPECT_TRUE(s);
    const Matrix mean = mean_observations(problem->tread_surface(), **s);
    return value_of<2>(*uniformity_functionals(*problem)[2].functional, *problem, psi, **s, mean);
  };
  const double between = dual_of(192), fitting = dual_of(256);
  EXPECT_NEAR(between, fitting, 0.02 * fitting);
}

}  // namespace
}  // namespace wheelwright
