#include "wheelwright/run/study/plane_comparison.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "wheelwright/case/read.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

/// A wheel of rubber with twelve slots, of which no sector is its own mirror image.
Case wheel(double width, const std::string& plane, double load_per_metre = 20e3) {
  const std::string text = fmt::format(R"(
[wheel]
inner_radius = 0.02
outer_radius = 0.05
width = {}
sectors = 12
[material]
youngs_modulus = 60e6
poissons_ratio = 0.45
plane = "{}"
[load]
force = {}
positions = 2
[[shape.slot]]
count = 12
center_radius = 0.0345
length = 0.014
width = 0.005
angle = 30
[grid]
radial_cells = 14
angular_cells = 144
tread_levels = 0
[optimizer]
rim_band = 0.0022
tread_band = 0.0045
)",
                                       width, plane, load_per_metre * width);
  CaseResult result = parse_case(text, "test.toml");
  for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
  return result.value.value_or(Case{});
}

PlaneComparison compared(const Case& c) {
  auto result = compare_planes(c);
  if (!result) throw std::runtime_error(result.failure().detail);
  return *result;
}

TEST(PlaneComparison, AThinDiscIsInPlaneStressAndALongRollerInPlaneStrain) {
  const PlaneComparison thin = compared(wheel(0.0005, "strain"));
  EXPECT_EQ(thin.recommended(), Plane::stress);
  EXPECT_NEAR(thin.error(Plane::stress), 0, 0.01);
  EXPECT_GT(thin.error(Plane::strain), 0.15);
  const PlaneComparison wide = compared(wheel(0.6, "strain"));
  EXPECT_EQ(wide.recommended(), Plane::strain);
  EXPECT_NEAR(wide.error(Plane::strain), 0, 0.03);
  EXPECT_LT(wide.error(Plane::stress), -0.1);
}

TEST(PlaneComparison, BetweenThemOnly3DIsAccurate) {
  Case c = wheel(0.055, "strain");
  c.material.poissons_ratio = 0.48;
  const PlaneComparison between = compared(c);
  EXPECT_GT(between.error(Plane::strain), 0.1);
  EXPECT_LT(between.error(Plane::stress), -0.1);
  EXPECT_EQ(between.recommended(), std::nullopt);
}

TEST(PlaneComparison, WarnsOfAPlaneThatIsFarFromThreeDimensionsOnly) {
  for (const std::string plane : {"strain", "stress"}) {
    const Case thin = wheel(0.0005, plane), wide = wheel(0.6, plane);
    EXPECT_EQ(plane_warning(thin, compared(thin)).has_value(), plane == "strain");
    EXPECT_EQ(plane_warning(wide, compared(wide)).has_value(), plane == "stress");
  }
}

template <int dim>
double stiffness(const Case& c) {
  const auto solver = *make_solver(rolling_model<dim>(c));
  const LevelSet<dim> shape = initial_shape<dim>(c);
  const auto state = solver->states(shape, solver->all_positions(), Interrupt());
  double force = 0, travel = 0;
  for (const auto& contact : (*state)->contacts()) {
    force += contact_summary(contact).radial_force;
    travel += contact_summary(contact).travel;
  }
  return force / travel * (dim == 2 ? c.wheel.width : 1);
}

// The errors that it predicts are those on a grid of half the cells' size, to three percent of the stiffness.
TEST(PlaneComparison, PredictsTheErrorsOnAFinerGrid) {
  Case c = wheel(0.02, "strain");
  const PlaneComparison predicted = compared(c);
  c.grid.radial_cells = 20;
  c.grid.angular_cells = 204;
  c.grid.level_set_degree = 1;
  const double strain = stiffness<2>(c);
  c.material.plane = Plane::stress;
  const double stress = stiffness<2>(c);
  c.material.plane = Plane::strain;
  c.wheel.dimension = 3;
  c.grid.axial_cells = 6;
  const double solid = stiffness<3>(c);
  EXPECT_NEAR(predicted.error(Plane::strain), strain / solid - 1, 0.03);
  EXPECT_NEAR(predicted.error(Plane::stress), stress / solid - 1, 0.03);
  EXPECT_GT(strain, solid);
  EXPECT_GT(solid, stress);
}

TEST(PlaneComparison, TakesTheFirstOfSeveralLoads) {
  Case c = wheel(0.02, "strain");
  CaseLoad heavy;
  heavy.name = "heavy";
  heavy.force = 3 * c.load.force;
  CaseLoad light;
  light.name = "light";
  light.force = 0.1 * c.load.force;
  c.load.cases = {heavy, light};
  Case alone = c;
  alone.load.cases.clear();
  alone.load.force = *heavy.force;
  EXPECT_EQ(compared(c).solid, compared(alone).solid);
}

}  // namespace
}  // namespace wheelwright
