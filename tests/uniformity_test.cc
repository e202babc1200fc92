#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/support.h"
#include "wheelwright/mechanics/rolling/neumann_to_dirichlet.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/functionals/mean_contact_stress.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"

namespace wheelwright {
namespace {

using testing::all_states;
using testing::evaluate_objective;
using testing::generic_hole;
using testing::holes;
using testing::paper_holes;
using testing::paper_model;
using testing::smooth_direction;
using testing::value_of;

RollingModel<2> annulus_model(int radial_cells, int angular_cells, int levels) {
  auto model = paper_model(radial_cells, angular_cells);
  model.tread = {1, levels, 3};
  model.n_positions = 4;  // on columns, for the mean
  return model;
}

std::shared_ptr<const NeumannToDirichlet<2>> image_of(const RollingModel<2>& model, DualNorm norm) {
  auto created = NeumannToDirichlet<2>::create(model, norm);
  EXPECT_TRUE(created);
  return std::make_shared<const NeumannToDirichlet<2>>(*std::move(created));
}

std::vector<std::shared_ptr<const Functional<2>>> uniformity_functionals(const RollingModel<2>& model) {
  return {std::make_shared<UniformityL2<2>>(0.01), std::make_shared<UniformityAnnulus<2>>(0.01),
          std::make_shared<UniformityDual<2>>(*image_of(model, DualNorm::elasticity)),
          std::make_shared<UniformityDual<2>>(*image_of(model, DualNorm::poisson))};
}

// p_mean of the shape itself, and held at an earlier shape's as the paper does.
TEST(Uniformity, GradientsPassTheTaylorTest) {
  const auto model = annulus_model(14, 192, 1);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = generic_hole(model.grid);
  const auto earlier =
      all_states<2>(*problem, holes(model.grid, 2, {{0.27, 0.5 * model.grid.sector_angle(), 0.04}}));
  ASSERT_TRUE(earlier);
  const Matrix held = mean_observations(problem->tread_surface(), **earlier);
  const auto direction = smooth_direction(psi.lattice);
  for (const auto& functional : uniformity_functionals(model)) {
    for (const Matrix* mean : {static_cast<const Matrix*>(nullptr), &held}) {
      const WeightedSum<2> objective{{1, functional}};
      const auto test = taylor_test<2>(
          [&](const LevelSet<2>& shape) { return evaluate_objective<2>(*problem, objective, shape, mean); },
          psi, direction, model.degree, 2e-5, 3);
      ASSERT_TRUE(test) << test.failure().detail;
      for (double order : test->orders)
        EXPECT_GT(order, 1.9) << functional->name() << (mean ? " held" : " own");
    }
  }
}

TEST(Uniformity, AUniformRingIsUniform) {
  const auto model = annulus_model(14, 192, 0);
  const auto problem = RollingProblem<2>::create(model);
  LevelSet<2> solid{Lattice<2>(model.grid, 2), {}};
  solid.values.assign(solid.lattice.n_nodes(), -1.0);
  const LevelSet<2> holed = paper_holes(model.grid);
  const auto value = [&](const Functional<2>& functional, const LevelSet<2>& psi) {
    const auto s = all_states<2>(*problem, psi);
    EXPECT_TRUE(s);
    return value_of<2>(functional, *problem, psi, **s, mean_observations(problem->tread_surface(), **s));
  };
  for (const auto& functional : uniformity_functionals(model)) {
    const double uniform = value(*functional, solid), uneven = value(*functional, holed);
    EXPECT_GT(uneven, 0) << functional->name();
    EXPECT_LT(std::abs(uniform), 1e-15 * uneven) << functional->name();
  }
}

// (71): the energy of w in the whole ring, half the work of the traction on w, and the value of the
// functional.
TEST(Uniformity, TheDualNormIsTheEnergyOfItsImage) {
  for (const auto& [levels, norm] : {std::pair{0, DualNorm::elasticity}, std::pair{2, DualNorm::elasticity},
                                     std::pair{0, DualNorm::poisson}, std::pair{2, DualNorm::poisson}}) {
    const auto model = annulus_model(14, 192, levels);
    const auto problem = RollingProblem<2>::create(model);
    const LevelSet<2> psi = paper_holes(model.grid);
    const auto s = all_states<2>(*problem, psi);
    ASSERT_TRUE(s);
    const Matrix mean = mean_observations(problem->tread_surface(), **s);
    const auto image = image_of(model, norm);
    const Matrix g = traction_deviation(problem->tread_surface(), **s, mean);
    const auto energies = image->energies(g);
    const Matrix w = (*image)(g);
    double work = 0;
    for (int j = 0; j < g.columns(); ++j)
      for (int i = 0; i < g.rows(); ++i)
        work += 0.5 * problem->tread().points()[i / 2].weight * g(i, j) * w(i, j);
    const double value = value_of<2>(UniformityDual<2>(*image), *problem, psi, **s, mean);
    EXPECT_NEAR(std::accumulate(energies.begin(), energies.end(), 0.0), value, 1e-9 * value);
    EXPECT_NEAR(work, value, 1e-12 * value);
  }
}

// Poisson's problem on the ring (Remark 7): a component cos(n azimuth) of the traction moves the tread by
// R_e / (E n) tanh(n ln(R_e / R_i)) of it, R_e / E ln(R_e / R_i) for n = 0, whatever Poisson's ratio is.
TEST(Uniformity, PoissonsImageOfAWaveIsThatOfTheRing) {
  const auto error = [](int radial_cells, int angular_cells, int n, double poissons_ratio) {
    auto model = annulus_model(radial_cells, angular_cells, 1);
    model.materials = Material{200e6, poissons_ratio};
    const auto problem = RollingProblem<2>::create(model);
    const auto& points = problem->tread().points();
    const double outer = model.grid.outer_radius, thickness = std::log(outer / model.grid.inner_radius);
    const double factor = outer / 200e6 * (n == 0 ? thickness : std::tanh(n * thickness) / n);
    Matrix g(2 * static_cast<int>(points.size()), model.grid.ring_columns()), expected = g;
    for (int j = 0; j < g.columns(); ++j)
      for (size_t q = 0; q < points.size(); ++q) {
        const double column = j * model.grid.column_angle();
        const auto [x, y] = points[q].position;
        const Vec<2> wave = rotated<2>({std::cos(n * (column + std::atan2(y, x))), 0.0}, -column);
        for (int d = 0; d < 2; ++d) {
          g(2 * static_cast<int>(q) + d, j) = wave[d];
          expected(2 * static_cast<int>(q) + d, j) = factor * wave[d];
        }
      }
    const Matrix w = (*image_of(model, DualNorm::poisson))(g);
    double largest = 0;
    for (int j = 0; j < w.columns(); ++j)
      for (int i = 0; i < w.rows(); ++i) largest = std::max(largest, std::abs(w(i, j) - expected(i, j)));
    return largest / factor;
  };
  for (const int n : {0, 1, 5, 12}) {
    const double coarse = error(7, 96, n, 0.3), fine = error(14, 192, n, 0.499);
    EXPECT_LT(coarse, 1e-3) << n;
    EXPECT_LT(fine, coarse / 7) << n;  // third order
  }
}

// With p_mean at the shape's own value nothing is left of its derivative: holding it gives the same gradient.
TEST(Uniformity, HoldingItsOwnMeanChangesNothing) {
  const auto model = annulus_model(14, 192, 0);
  const auto problem = RollingProblem<2>::create(model);
  const WeightedSum<2> objective{{1, std::make_shared<UniformityAnnulus<2>>(0.01)}};
  const auto psi = paper_holes(model.grid);
  const auto own = evaluate_objective<2>(*problem, objective, psi);
  ASSERT_TRUE(own);
  const auto held = evaluate_objective<2>(*problem, objective, psi, &own->mean_observations);
  ASSERT_TRUE(held);
  EXPECT_EQ(own->function("objective").value, held->function("objective").value);
  EXPECT_EQ(own->function("objective").gradient, held->function("objective").gradient);
}

}  // namespace
}  // namespace wheelwright
