// Radii of layers that a run chooses together with the shape.

#include "wheelwright/case/design_radii.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/run_support.h"
#include "tests/support.h"
#include "wheelwright/app/execute.h"
#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/run/checkpoints/provenance.h"
#include "wheelwright/run/study/moved_studies.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

Case case_of(const std::string& text) {
  const CaseResult result = parse_case(text, "test.toml");
  if (!result.value) throw std::runtime_error(result.problems.front().text());
  return *result.value;
}

/// A bush: rubber on a core, whose outer radius is to be chosen.
std::string bush(double least_stiffness) {
  return fmt::format(R"(
[wheel]
inner_radius = 0.01
outer_radius = 0.03
width = 0.05
sectors = 8
[material]
youngs_modulus = 2e6
poissons_ratio = 0.45
density = 1100
[[material.layer]]
name = "core"
outer_radius = 0.015
outer_radius_range = [0.013, 0.022]
youngs_modulus = 60e6
poissons_ratio = 0.3
density = 7800
[load]
force = 50
torque = 1
positions = 1
[contact]
with = "ring"
[grid]
radial_cells = 20
angular_cells = 128
[optimizer]
rim_band = 0.002
tread_band = 0.0035
[objective]
minimize = "mass"
layer = "core"
[[constraint]]
quantity = "torsional_stiffness"
at_least = {:.17g}
)",
                     least_stiffness);
}

/// [N/rad per metre of width]
double torsional_stiffness_of_bush(double radius) {
  const auto compliance = [](double youngs_modulus, double nu, double inner, double outer) {
    const double mu = youngs_modulus / (2 * (1 + nu));
    return (1 / (inner * inner) - 1 / (outer * outer)) / (4 * pi * mu);
  };
  return 1 / (compliance(60e6, 0.3, 0.01, radius) + compliance(2e6, 0.45, radius, 0.03));
}

/// The lightest core that makes the bush stiff enough is the one that makes it just so.
TEST(DesignRadii, OfTheLightestStiffBushAreTheExactOnes) {
  for (const double exact : {0.0171, 0.0193}) {
    const Case c = case_of(bush(torsional_stiffness_of_bush(exact)));
    const auto study = make_study<2>(c);
    ASSERT_TRUE(study) << study.failure().detail;
    const auto outcome = optimize<2>(
        optimizer_of(*study), study->initial, [](const auto&, const auto&) {}, [] { return false; });
    ASSERT_TRUE(outcome.state);
    const PolarGrid<2>& grid = outcome.state->shape.lattice.grid();
    const double found = radius_of_fixed_line(grid, study->model().design_lines.front());
    EXPECT_NEAR(found / exact, 1, 1e-3) << to_string(outcome.reason);
    EXPECT_LT(largest_violation(bound_constraints(outcome.state->evaluation)), 1e-3);
  }
}

/// A bound of the range that lies before the optimum holds.
TEST(DesignRadii, StayInTheirRange) {
  const Case c = case_of(bush(torsional_stiffness_of_bush(0.0245)));
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  const int line = study->model().design_lines.front();
  double largest = 0;
  const auto outcome = optimize<2>(
      optimizer_of(*study), study->initial,
      [&](const Trial<2>& trial, const auto&) {
        largest = std::max(largest, radius_of_fixed_line(trial.shape.lattice.grid(), line));
      },
      [] { return false; });
  ASSERT_TRUE(outcome.state);
  EXPECT_EQ(largest, 0.022);
  EXPECT_EQ(radius_of_fixed_line(outcome.state->shape.lattice.grid(), line), 0.022);
}

/// A wheel of two layers with holes across the interface; neither the holes nor the load are symmetric.
const std::string wheel = R"(
[wheel]
sectors = 8
[material]
youngs_modulus = 200e6
poissons_ratio = 0.4
density = 1200
[[material.layer]]
name = "core"
outer_radius = 0.268
outer_radius_range = [0.25, 0.29]
youngs_modulus = 900e6
poissons_ratio = 0.3
density = 2700
[load]
positions = 2
torque = 30
[contact]
friction = 0.4
[[holes.circle]]
center = [0.2687, 0.0426]
radius = 0.021
[[holes.circle]]
center = [0.2231, 0.1449]
radius = 0.017
[grid]
radial_cells = 14
angular_cells = 192
tread_levels = 0
[optimizer]
minimum_wall = 0
minimum_gap = 0
rim_band = 0.014
tread_band = 0.025
)";

/// Shape and radius move together: the objective changes as the move's model says, up to the second order.
/// From the second shape on, since the first is no spline.
TEST(DesignRadii, MoveWithTheShapeAsPredicted) {
  auto study = make_study<2>(case_of(wheel));
  ASSERT_TRUE(study) << study.failure().detail;
  study->optimizer.redistance_every = 0;
  const auto nothing = [](const auto&, const auto&) {};
  const auto on = [] { return false; };
  const auto at_first = optimizer_of(*study);
  auto second = at_first.start(study->initial, nothing);
  ASSERT_TRUE(second) << second.failure().detail;
  ASSERT_FALSE(at_first.advance(*second, nothing, on));
  const auto optimizer = at_first.on(second->shape.lattice.grid());
  ASSERT_TRUE(optimizer);
  const double radius = second->shape.lattice.grid().fixed_lines.front().radius,
               before = second->evaluation.function("objective").value;
  EXPECT_NE(radius, 0.268);
  double last = 0;
  for (const double step : {0.2, 0.1, 0.05}) {
    OptimizationState<2> state = *second;
    state.step = step;
    state.memory = {};
    const auto proposals = proposals_from(optimizer->evolver(), study->optimizer, state);
    ASSERT_TRUE(proposals);
    const auto move = (*proposals)->move(step);
    ASSERT_TRUE(move);
    EXPECT_GT(std::abs(move->radii.front() - radius), 0.2 * step * 0.01);
    std::optional<Trial<2>> first;
    optimizer->advance(
        state, [&](const Trial<2>& trial, const auto&) { first = first ? first : trial; }, on);
    ASSERT_TRUE(first && first->evaluation);
    const double change = first->evaluation->function("objective").value - before,
                 error = std::abs(change / move->objective_change - 1);
    EXPECT_LT(error, 0.5 * step);
    if (last > 0) {
      EXPECT_LT(error, 0.75 * last) << step;
    }
    last = error;
  }
}

TEST(DesignRadii, AreThoseOfTheGridOnEveryLevel) {
  const Case c = case_of(wheel);
  ASSERT_EQ(design_radii(c).size(), 1u);
  EXPECT_EQ(design_radii(c)[0].name, "outer_radius of core");
  const Case moved = with_design_radii(c, std::vector{0.2819});
  EXPECT_EQ(*moved.layers[0].outer_radius, 0.2819);
  for (const int level : {0, 1}) {
    const PolarGrid<2> grid = polar_grid<2>(on_coarser_grid(c, level)),
                       there = polar_grid<2>(on_coarser_grid(moved, level));
    ASSERT_EQ(grid.fixed_lines.size(), there.fixed_lines.size());
    for (std::size_t k = 0; k < grid.fixed_lines.size(); ++k)
      EXPECT_EQ(grid.fixed_lines[k].line, there.fixed_lines[k].line);
    EXPECT_EQ(there.fixed_lines[0].radius, 0.2819);
    EXPECT_EQ(grid.row_height(grid.cells[0] - 1), there.row_height(grid.cells[0] - 1));
    EXPECT_EQ(with_radii_of(c, there, level), moved);
  }
  EXPECT_EQ(level_of<2>(c, {Lattice<2>(polar_grid<2>(moved), 2), {}}), 0);
  EXPECT_EQ(provenance(c).resolved_case, provenance(moved).resolved_case);
  PolarGrid<2> other = polar_grid<2>(c);
  other.fixed_lines.clear();
  EXPECT_FALSE(with_radii_of(c, other));
}

/// Layers that meet keep meeting, and a range may be given on either side.
TEST(DesignRadii, OfLayersThatMeetAreOne) {
  const std::string text = R"(
[[material.layer]]
name = "core"
outer_radius = 0.26
youngs_modulus = 900e6
poissons_ratio = 0.3
[[material.layer]]
name = "band"
inner_radius = 0.26
inner_radius_range = [0.25, 0.27]
outer_radius = 0.30
youngs_modulus = 100e6
poissons_ratio = 0.3
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.02
)";
  const Case c = case_of(text);
  ASSERT_EQ(design_radii(c).size(), 1u);
  const Case moved = with_design_radii(c, std::vector{0.255});
  EXPECT_EQ(*moved.layers[0].outer_radius, 0.255);
  EXPECT_EQ(*moved.layers[1].inner_radius, 0.255);
  EXPECT_EQ(*moved.layers[1].outer_radius, 0.30);
}

/// Without ranges nothing is differentiated.
TEST(DesignRadii, AreAbsentWithoutRanges) {
  Case c = case_of(wheel);
  c.layers[0].outer_radius_range.reset();
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  EXPECT_TRUE(study->model().design_lines.empty());
  EXPECT_TRUE(study->optimizer.design_lines.empty());
  EXPECT_EQ(moved_studies(*study), nullptr);
}

class DesignRadiiOfARun : public testing::TemporaryFolder {};

/// The case of its folder has the radius of the last shape, and the history those of all.
TEST_F(DesignRadiiOfARun, AreInItsFiles) {
  Case c = case_of(wheel);
  c.optimizer.iterations = 4;
  c.output.folder = "run";
  {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const auto here = testing::fs::current_path();
    testing::fs::current_path(folder());
    Signals signals;
    begin_run(c, c.output.folder, signals);
    testing::fs::current_path(here);
    ::testing::internal::GetCapturedStdout();
    ::testing::internal::GetCapturedStderr();
  }
  const auto last = read_case(folder() / "run/case.toml");
  ASSERT_TRUE(last.value) << last.problems.front().text();
  const double radius = *last.value->layers[0].outer_radius;
  EXPECT_GT(std::abs(radius - 0.268), 1e-4);
  const auto rows = testing::split(testing::content(folder() / "run/history.csv"), '\n');
  const auto names = testing::split(rows.front(), ','), cells = testing::split(rows.back(), ',');
  const auto at = [&](const std::string& name) {
    return std::stod(cells[std::ranges::find(names, name) - names.begin()]);
  };
  EXPECT_EQ(at("outer_radius of core [m]"), radius);
  EXPECT_NE(at("objective by outer_radius of core [J/m/m]"), 0);
}

}  // namespace
}  // namespace wheelwright
