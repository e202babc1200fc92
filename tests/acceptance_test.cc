#include <gtest/gtest.h>

#include "tests/support.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {14, 12}};
const Lattice<2> lattice(grid, 2);

LevelSet<2> one_hole() { return make_level_set<2>(lattice, std::vector<Circle>{{0.268, 0.21, 0.021}}); }

/// An objective that has these values in the order of its calls, and the derivative of some smooth function.
class Scripted {
 public:
  explicit Scripted(std::vector<double> values) : values_(std::move(values)) {}

  Expected<Evaluation<2>> operator()(const LevelSet<2>& psi) {
    auto gradient = boundary_samples<2>(psi);
    for (auto& sample : gradient) sample.value = 1 + 0.3 * sample.normal[0] + 0.2 * sample.normal[1];
    return testing::evaluation_with<2>(values_.at(calls_++), gradient);
  }

 private:
  std::vector<double> values_;
  std::size_t calls_ = 0;
};

struct ScriptedRun {
  std::vector<Verdict> verdicts;
  std::vector<double> steps;
  std::optional<StopReason> stop;
  OptimizationState<2> state;
};

ScriptedRun run_with(std::vector<double> objectives, int iterations,
                     MeasureControl control = MeasureControl::exact,
                     std::optional<double> target_measure = {}) {
  OptimizerOptions options;
  options.target_measure = target_measure;
  options.iterations = iterations;
  options.accepted_increase = 0.01;
  options.tolerance = 0;
  options.max_halvings = 2;
  options.measure_control = control;
  const ShapeOptimizer<2> optimizer(lattice, {{ExtensionKind::h1, 2}, 0.04, {{0.012, 1}, {0.012, 1}}},
                                    options, testing::objective_of_shape<2>(Scripted(std::move(objectives))));
  std::vector<Verdict> verdicts;
  std::vector<double> steps;
  const auto observer = [&](const Trial<2>& trial, const OptimizationState<2>&) {
    verdicts.push_back(trial.verdict);
    steps.push_back(trial.step);
  };
  auto state = optimizer.start(one_hole(), observer);
  const StopReason stop = optimizer.run(*state, observer, [] { return false; });
  return {verdicts, steps, stop, *std::move(state)};
}

std::vector<double> objectives(const OptimizationState<2>& state) {
  std::vector<double> result;
  for (const AcceptedShape& shape : state.history) result.push_back(shape.objective);
  return result;
}

constexpr auto accepted = Verdict::accepted, rose = Verdict::objective_rose;

// Every value but the last is within 1 % of the shape before it; the last one is not within 1 % of the best.
TEST(Acceptance, SmallIncreasesDoNotAccumulate) {
  const ScriptedRun r = run_with({1, 0.9, 0.908, 0.916, 0.905}, 3);
  EXPECT_EQ(r.verdicts, (std::vector{accepted, accepted, accepted, rose, accepted}));
  EXPECT_EQ(objectives(r.state), (std::vector<double>{1, 0.9, 0.908, 0.905}));
}

TEST(Acceptance, TheBestShapeNeedNotBeTheFirstNorTheLast) {
  const ScriptedRun r = run_with({1, 0.8, 0.807, 0.809, 0.809, 0.81}, 3);
  EXPECT_EQ(r.verdicts, (std::vector{accepted, accepted, accepted, rose, rose, rose}));
  EXPECT_EQ(r.stop, StopReason::no_descent);
  EXPECT_EQ(r.state.iteration, 2);
}

TEST(Acceptance, TheMarginIsRelativeToTheMagnitudeOfTheBest) {
  const ScriptedRun small = run_with({1e-6, 1.009e-6, 1.011e-6, 1e-6}, 2);
  EXPECT_EQ(small.verdicts, (std::vector{accepted, accepted, rose, accepted}));
  const ScriptedRun negative = run_with({-1, -0.991, -0.989, -1}, 2);
  EXPECT_EQ(negative.verdicts, (std::vector{accepted, accepted, rose, accepted}));
}

TEST(Acceptance, PapersRuleAcceptsEveryIncrease) {
  const ScriptedRun r = run_with({1, 1.2, 1.5, 1.7}, 3, MeasureControl::proportional);
  EXPECT_EQ(r.verdicts, (std::vector{accepted, accepted, accepted, accepted}));
  EXPECT_EQ(r.steps, (std::vector<double>{0, 0.5, 0.5, 0.5}));
}

// A rejected trial halves the step, and so does a rise within bounds; a fall lets it grow by half, up to the
// step of the options.
TEST(Acceptance, TheStepFollowsTheVerdicts) {
  const ScriptedRun r = run_with({1, 1.005, 0.9, 0.95, 0.89, 0.88, 0.87}, 5);
  EXPECT_EQ(r.verdicts, (std::vector{accepted, accepted, accepted, rose, accepted, accepted, accepted}));
  EXPECT_EQ(r.steps, (std::vector<double>{0, 0.5, 0.25, 0.375, 0.1875, 0.28125, 0.421875}));
}

// Two and a half shapes of the rate away: objectives are compared from the third shape on, with the third.
TEST(Acceptance, ObjectivesAtOtherMeasuresAreNotCompared) {
  const double target =
      material_measure(one_hole()) - 2.5 * OptimizerOptions().measure_rate * sector_measure<2>(grid);
  const ScriptedRun r = run_with({1, 1.1, 0.9, 1.3, 1.32, 1.31, 1.2}, 5, MeasureControl::exact, target);
  EXPECT_EQ(r.verdicts, (std::vector{accepted, accepted, accepted, accepted, rose, accepted, accepted}));
  EXPECT_EQ(objectives(r.state), (std::vector<double>{1.3, 1.31, 1.2}));
  EXPECT_EQ(r.state.history_begin, 3);
  EXPECT_EQ(r.steps, (std::vector<double>{0, 0.5, 0.5, 0.5, 0.5, 0.25, 0.125}));
}

}  // namespace
}  // namespace wheelwright
