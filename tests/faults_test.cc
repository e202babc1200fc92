#include <gtest/gtest.h>

#include <limits>

#include "tests/support.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {14, 12}};
const Lattice<2> lattice(grid, 2);
const double sector = grid.sector_angle(), h = grid.resolution();
constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
const EvolutionOptions evolution{{ExtensionKind::h1, 2}, 0.04, {{0.01, 1}, {0.02, 1}}};

LevelSet<2> shape(const std::vector<Circle>& holes) { return make_level_set<2>(lattice, holes); }
LevelSet<2> one_hole() { return shape({{0.262, 0.4 * sector, 0.025}}); }

/// A gradient that varies along the boundary.
std::vector<SurfaceSample<2>> some_gradient(const LevelSet<2>& psi) {
  auto samples = boundary_samples<2>(psi);
  for (auto& sample : samples) sample.value = 1 + sample.normal[1];
  return samples;
}

template <class T>
void expect_not_finite(const Expected<T>& result) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.failure().reason, FailureReason::not_finite);
}

// --- every stage of the evolution ---

class BadValue : public ::testing::TestWithParam<double> {};

TEST_P(BadValue, InTheGradientFailsTheVelocity) {
  for (ExtensionKind kind : {ExtensionKind::h1, ExtensionKind::harmonic}) {
    const Evolver<2> evolver(lattice, {{kind, 2}, 0, {{0.01, 1}, {0.02, 1}}, {}});
    auto gradient = some_gradient(one_hole());
    gradient[3].value = GetParam();
    expect_not_finite(evolver.velocity(gradient));
    expect_not_finite(evolver.measure_preserving_velocity(gradient));
    gradient[3].value = 1;
    gradient[3].weight = GetParam();
    EXPECT_FALSE(evolver.velocity(gradient));
    EXPECT_FALSE(evolver.measure_preserving_velocity(gradient));
  }
}

TEST_P(BadValue, InTheVelocityFailsTheTransport) {
  const Evolver<2> evolver(lattice, evolution);
  std::vector<double> velocity(lattice.n_nodes(), 1.0);
  ASSERT_TRUE(evolver.move(one_hole(), velocity, 0.5 * h));
  for (int node : {0, lattice.n_nodes() / 2, lattice.n_nodes() - 1}) {
    auto bad = velocity;
    bad[node] = GetParam();
    expect_not_finite(evolver.move(one_hole(), bad, 0.5 * h));
  }
}

// A node without a value takes its distance from the nearest boundary, and its sign from a comparison.
TEST_P(BadValue, InTheLevelSetIsNotHiddenByTheNextStage) {
  const Evolver<2> evolver(lattice, evolution);
  const std::vector<double> velocity(lattice.n_nodes(), 1.0);
  for (int node : {5, lattice.n_nodes() / 2, lattice.n_nodes() - 1}) {
    auto psi = one_hole();
    psi.values[node] = GetParam();
    expect_not_finite(evolver.move(psi, velocity, 0.5 * h));
    expect_not_finite(evolver.redistance(psi));
    expect_not_finite(evolver.smooth(psi));
    expect_not_finite(evolver.without_islands(psi, 1));
    expect_not_finite(evolver.with_measure(psi, 0.01, 0.1));
    EXPECT_TRUE(std::isnan(material_measure(psi)));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BadValue, ::testing::Values(nan, infinity, -infinity));

TEST(Transport, NeedsAVelocityThatMoves) {
  const std::vector<double> at_rest(lattice.n_nodes(), 0.0);
  expect_not_finite(Evolver<2>(lattice, evolution).move(one_hole(), at_rest, 0.5 * h));
}

// --- the loop ---

/// J = 1 / int (material that leans to one side), with a fault in some of its evaluations.
class FaultyObjective {
 public:
  using Fault = std::function<void(Evaluation<2>&)>;
  FaultyObjective(std::vector<int> faulty_calls, Fault fault)
      : faulty_calls_(std::move(faulty_calls)), fault_(std::move(fault)) {}

  Expected<Evaluation<2>> operator()(const LevelSet<2>& psi) {
    double objective = 0;
    auto gradient = some_gradient(psi);
    for (const auto& sample : gradient) {
      const auto cell = grid.cell_position(sample.cell);
      const double radius = grid.radius(cell[0] + sample.xi[0]);
      const double azimuth = (cell[1] + sample.xi[1]) * grid.column_angle();
      // The area of the hole about the point (0.3, 0.3 sector): the divergence theorem.
      const Vec<2> x = cartesian<2>({radius, azimuth}), middle = cartesian<2>({0.3, 0.3 * sector});
      const Vec<2> d{x[0] - middle[0], x[1] - middle[1]};
      objective -= sample.weight * dot<2>(sample.normal, d) * dot<2>(d, d) / 4;
    }
    for (auto& sample : gradient) {
      const auto cell = grid.cell_position(sample.cell);
      const Vec<2> x =
          cartesian<2>({grid.radius(cell[0] + sample.xi[0]), (cell[1] + sample.xi[1]) * grid.column_angle()});
      const Vec<2> middle = cartesian<2>({0.3, 0.3 * sector});
      sample.value = -(std::pow(x[0] - middle[0], 2) + std::pow(x[1] - middle[1], 2));
    }
    auto result = wheelwright::testing::evaluation_with<2>(objective, gradient);
    const int call = calls_++;
    const bool faulty = std::find(faulty_calls_.begin(), faulty_calls_.end(), call) != faulty_calls_.end();
    if (faulty || (faulty_calls_.empty() && call > 0)) fault_(result);
    return result;
  }

 private:
  std::vector<int> faulty_calls_;  ///< empty: all but the first
  Fault fault_;
  int calls_ = 0;
};

struct Course {
  Outcome<2> outcome;
  std::vector<Trial<2>> trials;
};

Course run(const LevelSet<2>& initial, const OptimizerOptions& options,
           const std::function<Expected<Evaluation<2>>(const LevelSet<2>&)>& objective) {
  Course course{};
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(objective));
  course.outcome = optimize<2>(
      optimizer, initial,
      [&](const Trial<2>& trial, const OptimizationState<2>&) { course.trials.push_back(trial); },
      [] { return false; });
  return course;
}

const std::vector<std::pair<FailureReason, FaultyObjective::Fault>> faults{
    {FailureReason::not_finite, [](Evaluation<2>& e) { e.functions[0].value = nan; }},
    {FailureReason::not_finite, [](Evaluation<2>& e) { e.functions[0].gradient[7] = -infinity; }},
    {FailureReason::not_finite, [](Evaluation<2>& e) { e.boundary[7].weight = nan; }},
    {FailureReason::objective_jumped, [](Evaluation<2>& e) { e.functions[0].value *= 1e-3; }},
    {FailureReason::objective_jumped, [](Evaluation<2>& e) { e.functions[0].value *= 50; }},
};

TEST(FaultyObjective, IsRejectedAndTheRunContinues) {
  OptimizerOptions options;
  options.iterations = 6;
  const Course sound = run(one_hole(), options, FaultyObjective({-1}, {}));
  ASSERT_EQ(sound.outcome.reason, StopReason::iterations);
  for (const auto& trial : sound.trials) EXPECT_EQ(trial.verdict, Verdict::accepted);
  for (MeasureControl control : {MeasureControl::exact, MeasureControl::proportional})
    for (const auto& [reason, fault] : faults) {
      options.measure_control = control;
      const Course course = run(one_hole(), options, FaultyObjective({2, 3, 6}, fault));
      ASSERT_EQ(course.outcome.reason, StopReason::iterations);
      for (int k : {2, 3, 6}) {
        EXPECT_EQ(course.trials[k].verdict, Verdict::failed);
        ASSERT_TRUE(course.trials[k].failure);
        EXPECT_EQ(course.trials[k].failure->reason, reason);
        EXPECT_EQ(course.trials[k + 1].step, course.trials[k].step / 2);
      }
      EXPECT_EQ(course.outcome.state->iteration, 6);
      EXPECT_TRUE(std::isfinite(course.outcome.state->evaluation.function("objective").value));
    }
}

TEST(FaultyObjective, PersistentFaultMakesTheRunGiveUp) {
  OptimizerOptions options;
  options.max_halvings = 4;
  for (const auto& [reason, fault] : faults) {
    const Course course = run(one_hole(), options, FaultyObjective({}, fault));
    EXPECT_EQ(course.outcome.reason, StopReason::gave_up);
    EXPECT_EQ(course.outcome.state->iteration, 0);
    // The shape that does not move is as faulty: the fourth and the fifth trial would be in vain.
    ASSERT_EQ(course.trials.size(), 5u);
    for (std::size_t k = 1; k < course.trials.size(); ++k)
      EXPECT_EQ(course.trials[k].failure->reason, reason);
    EXPECT_EQ(course.trials[3].step, options.step / 4);
    EXPECT_EQ(course.trials.back().step, 0);
  }
}

TEST(FaultyObjective, InTheInitialShapeFailsTheStart) {
  const Course course = run(one_hole(), {}, FaultyObjective({0}, faults[0].second));
  EXPECT_EQ(course.outcome.reason, StopReason::failed_start);
  EXPECT_EQ(course.outcome.failure->reason, FailureReason::not_finite);
}

// A gradient that is finite, and whose velocity is not.
TEST(FaultyObjective, WhoseVelocityOverflowsMakesTheRunGiveUp) {
  const Course course = run(one_hole(), {}, FaultyObjective({0}, [](Evaluation<2>& e) {
                              for (size_t q = 0; q < e.boundary.size(); ++q)
                                e.functions[0].gradient[q] = 1e308 * e.boundary[q].normal[0];
                            }));
  EXPECT_EQ(course.outcome.reason, StopReason::gave_up);
  ASSERT_EQ(course.trials.size(), 2u);
  EXPECT_EQ(course.trials[1].verdict, Verdict::failed);
  EXPECT_EQ(course.trials[1].failure->reason, FailureReason::not_finite);
}

// --- islands and holes in the loop ---

TEST(Loop, RemovesAnIslandAndKeepsTheMeasure) {
  auto psi = shape({{0.27, 0.5 * sector, 0.03}});
  const auto island = shape({{0.27, 0.5 * sector, 0.008}});
  for (int node = 0; node < lattice.n_nodes(); ++node)
    psi.values[node] = std::min(psi.values[node], -island.values[node]);
  OptimizerOptions options;
  options.iterations = 1;
  options.target_measure = material_measure(psi);
  options.largest_island = 0.05;
  const Course course = run(psi, options, FaultyObjective({-1}, {}));
  ASSERT_EQ(course.trials.size(), 2u);
  ASSERT_EQ(course.trials[0].events.size(), 1u);
  EXPECT_EQ(course.trials[0].events[0].kind, ShapeEventKind::island_removed);
  for (const auto& trial : course.trials)
    EXPECT_NEAR(trial.measure, *options.target_measure, 1e-6 * trial.measure);
  options.largest_island = 1e-3;
  EXPECT_EQ(run(psi, options, FaultyObjective({-1}, {})).outcome.failure->reason,
            FailureReason::disconnected_material);
}

std::vector<ShapeEventKind> events_of_gathering(const std::vector<Circle>& holes) {
  OptimizerOptions options;
  options.iterations = 40;
  std::vector<ShapeEventKind> kinds;
  for (const auto& trial : run(shape(holes), options, FaultyObjective({-1}, {})).trials)
    for (const auto& event : trial.events) {
      EXPECT_EQ(trial.verdict, Verdict::accepted);
      kinds.push_back(event.kind);
    }
  return kinds;
}

// The holes gather about a point: equal ones on both sides of it meet there, across the sector's face, too;
// one that is farther away gives its area to the nearer.
TEST(Loop, ReportsHolesThatMergeAndVanish) {
  using enum ShapeEventKind;
  EXPECT_EQ(events_of_gathering({{0.29, 0.16 * sector, 0.014}, {0.29, 0.44 * sector, 0.014}}),
            (std::vector{holes_merged, hole_at_tread_band}));
  EXPECT_EQ(events_of_gathering({{0.28, 0.25 * sector, 0.015}, {0.28, 0.66 * sector, 0.015}}),
            (std::vector{hole_vanished, hole_at_tread_band}));
}

}  // namespace
