#include <gtest/gtest.h>

#include <numeric>

#include "tests/support.h"
#include "tests/von_mises.h"
#include "wheelwright/case/case.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using testing::evaluate_objective;
using testing::generic_hole;
using testing::paper_model;
using testing::relative_difference;

const Material sheet{60e6, 0.4, Plane::stress};

/// A wheel without symmetry, with friction, a driving torque, weight and a pressure in its holes.
RollingModel<2> wheel_of(const Material& material) {
  auto model = paper_model(14, 192);
  model.materials = material;
  model.tread = {1, 1, 3};
  model.n_positions = 4;
  model.load = 8000;
  model.contact.friction = 0.3;
  model.torque = 300;
  model.distributed = {{20e3, 5e3}, 1e4};
  return model;
}

WeightedSum<2> all_functionals(const RollingProblem<2>& problem) {
  auto image = problem.neumann_to_dirichlet(DualNorm::elasticity);
  EXPECT_TRUE(image);
  return {{1, std::make_shared<StrainEnergy<2>>()},
          {3, std::make_shared<UniformityL2<2>>(0.01)},
          {6, std::make_shared<UniformityAnnulus<2>>(0.01)},
          {10, std::make_shared<UniformityDual<2>>(*std::move(image))}};
}

// The equations in the plane are the same: stiffness, ghost penalty, contact and functionals.
TEST(PlaneStress, IsPlaneStrainOfTheEquivalentMaterial) {
  const auto in_stress = RollingProblem<2>::create(wheel_of(sheet)),
             in_strain = RollingProblem<2>::create(wheel_of(sheet.plane_strain_equivalent()));
  ASSERT_TRUE(in_stress && in_strain);
  const LevelSet<2> psi = generic_hole(in_stress->model().grid);
  const auto a = evaluate_objective<2>(*in_stress, all_functionals(*in_stress), psi),
             b = evaluate_objective<2>(*in_strain, all_functionals(*in_strain), psi);
  ASSERT_TRUE(a && b);
  const auto &objective = a->function("objective"), &other = b->function("objective");
  EXPECT_NEAR(objective.value, other.value, 1e-12 * other.value);
  EXPECT_LT(relative_difference(objective.by_position, other.by_position), 1e-12);
  EXPECT_LT(relative_difference(objective.gradient, other.gradient), 1e-10);

  const auto s = testing::all_states<2>(*in_stress, psi), t = testing::all_states<2>(*in_strain, psi);
  ASSERT_TRUE(s && t);
  for (int i = 0; i < (*s)->positions().size(); ++i) {
    const auto u = (*s)->displacement().at_nodes(i), v = (*t)->displacement().at_nodes(i);
    for (size_t k = 0; k < u.values.size(); ++k) {
      if (!std::isnan(v.values[k])) {
        EXPECT_NEAR(u.values[k], v.values[k], 1e-13);
      }
    }
  }
  const auto stresses = (*s)->strain_peaks().von_mises, others = (*t)->strain_peaks().von_mises;
  for (size_t i = 0; i < stresses.size(); ++i) EXPECT_GT(stresses[i], 1.01 * others[i]);
}

TEST(PlaneStress, GradientsPassTheTaylorTest) {
  const auto problem = RollingProblem<2>::create(wheel_of(sheet));
  ASSERT_TRUE(problem);
  const auto functionals = all_functionals(*problem);
  for (const auto& term : functionals) {
    const auto test = testing::generic_taylor_test(*problem, {term});
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9) << term.functional->name();
  }
}

// Both from von Mises' formula in three dimensions, with the strain or the stress along the axle put in.
TEST(PlaneStress, PeakOfVonMisesIsThatOfThreeDimensions) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const Material material{60e6, 0.4, plane}, in_space{60e6, 0.4};
    const auto problem = RollingProblem<2>::create(wheel_of(material));
    ASSERT_TRUE(problem);
    const LevelSet<2> psi = generic_hole(problem->model().grid);
    const auto state = testing::all_states<2>(*problem, psi);
    ASSERT_TRUE(state);
    const Displacement<2>& displacement = (*state)->displacement();
    const PolarGrid<2>& grid = problem->model().grid;
    const int n_positions = (*state)->positions().size();
    const auto full = unit_cell_rule<2>(problem->model().degree + 1);
    std::vector<double> expected(n_positions, 0.0);
    const auto visit = [&](int cell, const std::vector<ReferencePoint<2>>& points) {
      std::vector<Vec<2>> xi;
      for (const auto& point : points) xi.push_back(point.xi);
      const Matrix strains = displacement.strains(cell, xi).by_rows();
      for (int j = 0; j < strains.columns(); ++j)
        for (int row = 0; row < strains.rows(); row += 3) {
          const double* e = strains.column(j) + row;
          const double axial = plane == Plane::strain ? 0 : -0.4 / 0.6 * (e[0] + e[1]);
          const double value =
              testing::von_mises<3>(in_space, stress<3>(in_space, {e[0], e[1], axial, 0, 0, e[2]}));
          expected[j / grid.n_sectors] = std::max(expected[j / grid.n_sectors], value);
        }
    };
    for (int cell = 0; cell < grid.n_cells(); ++cell)
      if ((*state)->domain().kinds[cell] == CellKind::inside) visit(cell, full);
    for (const auto& cut : (*state)->domain().cut) visit(cut.cell, cut.material);
    const auto peaks = (*state)->strain_peaks().von_mises;
    for (int i = 0; i < n_positions; ++i) EXPECT_NEAR(peaks[i], expected[i], 1e-10 * expected[i]);
  }
}

TEST(PlaneStress, IsRefusedInThreeDimensions) {
  Case c;
  c.material.plane = Plane::stress;
  const auto study = make_study<3>(c);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.failure().reason, FailureReason::unsupported_model);
  EXPECT_NE(study.failure().detail.find("plane stress"), std::string::npos);
}

}  // namespace
}  // namespace wheelwright
