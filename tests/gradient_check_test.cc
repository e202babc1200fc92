#include "wheelwright/run/study/gradient_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "wheelwright/case/read.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {
namespace {

Case case_of(const std::string& text) {
  CaseResult result = parse_case(text, "test.toml");
  for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
  return result.value.value_or(Case{});
}

template <int dim>
Study<dim> study_of(const Case& c) {
  const auto study = make_study<dim>(c);
  if (!study) throw std::runtime_error(study.failure().detail);
  return *study;
}

template <int dim>
std::vector<GradientCheck> checked(const Case& c) {
  const Study<dim> study = study_of<dim>(c);
  const auto checks = check_gradients(study, study.initial);
  if (!checks) throw std::runtime_error(checks.failure().detail);
  return *checks;
}

/// Those with respect to radii, which must be these.
template <int dim>
std::vector<GradientCheck> checked_radii(const Case& c, const std::vector<std::string>& radii) {
  const Study<dim> study = study_of<dim>(c);
  const auto checks = check_radii(study, study.initial);
  if (!checks) throw std::runtime_error(checks.failure().detail);
  EXPECT_EQ(checks->size(), radii.size() * study.functions.size());
  for (size_t i = 0; i < checks->size(); ++i)
    EXPECT_EQ((*checks)[i].radius, radii[i / study.functions.size()]);
  return *checks;
}

void expect_passed(const std::vector<GradientCheck>& checks, size_t n_functions) {
  EXPECT_EQ(checks.size(), n_functions);
  for (const GradientCheck& check : checks)
    EXPECT_FALSE(check.failed()) << check.function << ' ' << check.radius << ": order "
                                 << check.lowest_order() << ", error " << check.largest_error() << ", step "
                                 << check.test.steps.front();
}

const std::string coarse = R"(
[grid]
radial_cells = 14
angular_cells = 192
tread_levels = 0
[optimizer]
tread_band = 0.02
)";

/// Its edges lie on the bands at rim and tread, and on lines of the grid.
const std::string slots_between_bands = R"(
[wheel]
sectors = 8
[load]
positions = 3
[[shape.slot]]
count = 16
center_radius = 0.265
length = 0.108
width = 0.04
)" + coarse;

TEST(GradientCheck, ItsDirectionLeavesTheSameCellsCutOnEveryWheel) {
  const Case c = case_of(slots_between_bands);
  const LevelSet<2> psi = initial_shape<2>(c);
  const double step = 1e-3 * psi.lattice.grid().resolution();
  for (int number = 0; number < 3; ++number) {
    const auto direction = test_direction(psi, number, step);
    EXPECT_GT(std::ranges::max(direction), 0.5);
    const auto kinds = [&](double t) {
      LevelSet<2> moved = psi;
      for (size_t i = 0; i < direction.size(); ++i) moved.values[i] += t * direction[i];
      return cut_domain(moved, 2)->kinds;
    };
    EXPECT_EQ(kinds(step), kinds(0));
    EXPECT_EQ(kinds(-step), kinds(0));
  }
}

TEST(GradientCheck, PassesOnAWheelWhoseEdgesLieOnTheBands) {
  expect_passed(checked<2>(case_of(slots_between_bands)), 2);
}

TEST(GradientCheck, PassesWithFrictionTorqueSeveralLoadsAndBounds) {
  expect_passed(checked<2>(case_of(slots_between_bands + R"(
[contact]
friction = 0.5
[material]
density = 1100
[objective]
minimize = "mass"
[[load.case]]
name = "straight"
[[load.case]]
name = "driven"
torque = 200
[[load.case]]
name = "fast"
speed = 20
[[constraint]]
quantity = "stiffness"
at_least = 1e6
[[constraint]]
quantity = "peak_pressure"
load_case = "driven"
at_most = 1e7
)")),
                6);
}

TEST(GradientCheck, PassesInThreeDimensions) {
  expect_passed(checked<3>(case_of(R"(
[wheel]
dimension = 3
sectors = 16
[load]
positions = 2
lateral_force = 100
[contact]
friction = 0.5
[[holes.tapered]]
count = 16
center_radius = 0.27
profile = [[-0.06, 0.02], [0, 0.024], [0.06, 0.028]]
[[constraint]]
quantity = "stiffness"
at_least = 1e6
[grid]
radial_cells = 7
angular_cells = 96
axial_cells = 3
[optimizer]
rim_band = 0.02
tread_band = 0.04
)")),
                3);
}

/// Two layers whose radii are unknowns, and a hole across both of their edges, without symmetry.
const std::string layers = R"(
[material]
youngs_modulus = 2e8
poissons_ratio = 0.4
density = 1200
[[material.layer]]
name = "core"
outer_radius = 0.2531
outer_radius_range = [0.24, 0.26]
youngs_modulus = 9e8
poissons_ratio = 0.3
density = 2700
[[material.layer]]
name = "tyre"
inner_radius = 0.2872
inner_radius_range = [0.28, 0.295]
youngs_modulus = 5e7
poissons_ratio = 0.45
density = 1100
)";

const std::string grid_of_layers = R"(
[grid]
radial_cells = 16
angular_cells = 192
tread_levels = 0
[optimizer]
tread_band = 0.02
)";

TEST(GradientCheck, OfRadiiPassesWithFrictionSeveralLoadsAndBounds) {
  const auto checks = checked_radii<2>(case_of(R"(
[wheel]
sectors = 8
[load]
positions = 2
[contact]
friction = 0.4
[[holes.circle]]
center = [0.2687, 0.0426]
radius = 0.031
[[load.case]]
name = "straight"
[[load.case]]
name = "driven"
torque = 60
[[constraint]]
quantity = "mass"
at_most = 100
[[constraint]]
quantity = "stiffness"
at_least = 1e6
[[constraint]]
quantity = "peak_von_mises"
at_most = 1e9
)" + layers + grid_of_layers),
                                       {"outer_radius of core", "inner_radius of tyre"});
  expect_passed(checks, 2 * 7);
  EXPECT_EQ(std::ranges::count_if(checks, &GradientCheck::is_smoothed), 2 * 2);
}

TEST(GradientCheck, OfRadiiPassesInThreeDimensions) {
  const auto checks = checked_radii<3>(case_of(R"(
[wheel]
dimension = 3
sectors = 16
[load]
positions = 1
lateral_force = 100
[contact]
friction = 0.5
[[material.layer]]
name = "core"
outer_radius = 0.2571
outer_radius_range = [0.25, 0.27]
youngs_modulus = 9e8
poissons_ratio = 0.3
[[holes.tapered]]
count = 16
center_radius = 0.26
profile = [[-0.06, 0.016], [0, 0.02], [0.06, 0.024]]
[grid]
radial_cells = 7
angular_cells = 64
axial_cells = 2
[optimizer]
rim_band = 0.03
tread_band = 0.05
)"),
                                       {"outer_radius of core"});
  expect_passed(checks, 2);
}

/// Also where no hole can move: rubber on a core.
TEST(GradientCheck, OfRadiiPassesWithoutHoles) {
  expect_passed(
      checked_radii<2>(case_of(layers + grid_of_layers), {"outer_radius of core", "inner_radius of tyre"}),
      2 * 2);
  EXPECT_TRUE(checked_radii<2>(case_of(slots_between_bands), {}).empty());
}

// A derivative that is wrong by a hundredth shows in the order, one that is right does not.
TEST(GradientCheck, FindsAWrongDerivative) {
  const auto check_of = [](double derivative) {
    GradientCheck check{"objective",
                        {.value = 1, .derivative = derivative, .steps = {}, .remainders = {}, .orders = {}}};
    for (double t = 1e-3; t > 1e-4; t /= 2) {
      check.test.steps.push_back(t);
      check.test.remainders.push_back(std::abs(2 * t + 3 * t * t - t * derivative));
    }
    for (size_t k = 1; k < check.test.steps.size(); ++k)
      check.test.orders.push_back(std::log2(check.test.remainders[k - 1] / check.test.remainders[k]));
    return check;
  };
  EXPECT_TRUE(check_of(2).passed());
  EXPECT_FALSE(check_of(2.02).passed());
  EXPECT_FALSE(check_of(0).passed());
}

// A quantity that the case prescribes does not change with the shape.
TEST(GradientCheck, ConstantIsNotAFailure) {
  const GradientCheck check{
      "travel", {.value = 1, .derivative = 0, .steps = {1e-3, 5e-4}, .remainders = {0, 0}, .orders = {0}}};
  EXPECT_TRUE(check.passed());
}

}  // namespace
}  // namespace wheelwright
