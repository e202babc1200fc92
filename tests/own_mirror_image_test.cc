// Functionals that are not their own mirror image: they are computed on all positions and the whole width.

#include <gtest/gtest.h>

#include "tests/support.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/quantities/functionals/over_positions.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using testing::all_states;
using testing::evaluate_objective;

/// The moment of the ground's pressure about the middle of its ground position: along the ground, or across
/// it when dim = 3. The mirror image of a state has the opposite one.
template <int dim>
class PressureMoment : public Functional<dim> {
 public:
  explicit PressureMoment(int axis) : axis_(axis) {}

  std::string name() const override { return "pressure_moment"; }

  FunctionalValue<dim> evaluate(const StateSolver<dim>&, const LevelSet<dim>&, const State<dim>& state,
                                const Matrix&) const override {
    FunctionalValue<dim> value;
    for (const ContactPatch<dim>& contact : state.contacts()) {
      double moment = 0;
      std::vector<Vec<dim>> by_traction;
      for (const auto& point : contact.points) {
        const double lever = point.weight * point.position[axis_];
        moment -= lever * point.traction[0];
        by_traction.push_back({-lever});
      }
      value.by_position.push_back(moment);
      value.derivative.tractions.push_back(std::move(by_traction));
    }
    return value;
  }

 private:
  int axis_;
};

RollingModel<2> plane_model() {
  RollingModel<2> model = testing::paper_model(14, 192);
  model.n_positions = 4;
  return model;
}

/// Its mirror image is another direction.
std::vector<double> lopsided_direction(const Lattice<2>& lattice) {
  std::vector<double> direction;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    const Vec<2> p = lattice.polar_point(i);
    direction.push_back(1 + 0.4 * std::sin(16 * p[1]) + 0.3 * std::sin(40 * (p[0] - 0.27)));
  }
  return direction;
}

LevelSet<2> symmetric_hole(const PolarGrid<2>& grid) {
  return testing::holes(grid, 2, {{0.2681, 0.5 * grid.sector_angle(), 0.0373}});
}

template <int dim>
void expect_second_order(const StateSolver<dim>& solver, const WeightedSum<dim>& terms,
                         const LevelSet<dim>& psi, const std::vector<double>& direction, double step) {
  const auto test = taylor_test<dim>(
      [&](const LevelSet<dim>& shape) { return evaluate_objective<dim>(solver, terms, shape); }, psi,
      direction, solver.model().degree, step, 3);
  ASSERT_TRUE(test) << test.failure().detail;
  EXPECT_GT(std::abs(test->derivative) * step, 10 * test->remainders.front());
  for (const double order : test->orders) EXPECT_GT(order, 1.9);
}

TEST(OwnMirrorImage, TheGradientOfAnOddFunctionalIsExact) {
  const auto problem = RollingProblem<2>::create(plane_model());
  ASSERT_TRUE(problem);
  const WeightedSum<2> moment{{1, std::make_shared<PressureMoment<2>>(1)}};
  const PolarGrid<2>& grid = problem->model().grid;
  for (const LevelSet<2>& psi : {symmetric_hole(grid), testing::generic_hole(grid)})
    expect_second_order<2>(*problem, moment, psi, lopsided_direction(psi.lattice), 2e-5);
}

TEST(OwnMirrorImage, OfASymmetricWheelHasOppositeValuesAtMirrorImages) {
  const auto problem = RollingProblem<2>::create(plane_model());
  ASSERT_TRUE(problem);
  const auto evaluation = evaluate_objective<2>(*problem, {{1, std::make_shared<PressureMoment<2>>(1)}},
                                                symmetric_hole(problem->model().grid));
  ASSERT_TRUE(evaluation);
  const double value = evaluation->functions[0].value;
  const std::vector<double>& moments = evaluation->functions[0].by_position;
  ASSERT_EQ(moments.size(), 4u);
  const double size = std::abs(moments[1]);
  EXPECT_GT(size, 0.01);
  EXPECT_NEAR(moments[3], -moments[1], 1e-7 * size);
  EXPECT_NEAR(moments[0], 0, 1e-7 * size);
  EXPECT_NEAR(moments[2], 0, 1e-7 * size);
  EXPECT_NEAR(value, 0, 1e-7 * size);
}

// The ground holds a wheel that rolls straight ahead against small forces along it, which change their sign.
TEST(OwnMirrorImage, TheWorstForceAlongTheGroundIsThatOfAllPositions) {
  RollingModel<2> model = plane_model();
  model.contact.friction = 0.5;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto force = std::make_shared<GroundForce<2>>(RimWay::along_ground);
  const WeightedSum<2> worst{{1, std::make_shared<FunctionOfPositions<2>>("worst", force, maximum_of)}};
  const LevelSet<2> psi = symmetric_hole(problem->model().grid);
  const auto states = all_states<2>(*problem, psi);
  const auto evaluation = evaluate_objective<2>(*problem, worst, psi);
  ASSERT_TRUE(states && evaluation);
  const auto forces = force->evaluate(*problem, psi, **states, {}).by_position;
  EXPECT_GT(std::ranges::max(forces), 1);
  EXPECT_NEAR(evaluation->functions[0].value, std::ranges::max(forces), 1e-9 * std::ranges::max(forces));
}

/// A wheel in space and a hole that is symmetric across the width.
RollingModel<3> space_model() {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.12, 16, {7, 8, 4}};
  model.degree = 1;
  model.materials = Material{200e6, 0.3};
  model.load = 2943;
  model.n_positions = 1;
  model.contact_points = 3;
  return model;
}

TEST(OwnMirrorImage, TheGradientOfAFunctionalThatIsOddAcrossTheWidthIsExact) {
  const RollingModel<3> model = space_model();
  const auto solver = HalfWidthSolver::create(model);
  ASSERT_TRUE(solver);
  const Circle hole{0.2581, 0.47 * model.grid.sector_angle(), 0.0253};
  const LevelSet<3> psi = make_level_set<3>(Lattice<3>(model.grid, 1), std::span(&hole, 1));
  ASSERT_TRUE(is_mirror_symmetric(psi, MirrorPlane::width));
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    direction.push_back(1 + 0.5 * std::sin(20 * (psi.lattice.polar_point(i)[2] - 0.5 * model.grid.width)));
  const WeightedSum<3> moment{{1, std::make_shared<PressureMoment<3>>(2)}};
  const auto evaluation = evaluate_objective<3>(**solver, moment, psi);
  ASSERT_TRUE(evaluation);
  EXPECT_NEAR(evaluation->functions[0].value, 0, 1e-9 * model.load * model.grid.width);
  expect_second_order<3>(**solver, moment, psi, direction, 2e-5);
}

}  // namespace
}  // namespace wheelwright
