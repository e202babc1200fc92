#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/optimization/optimizer/sequential_quadratic.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

const PolarGrid<2> grid{0.20, 0.34, 0.12, 16, {28, 24}};
const Lattice<2> lattice(grid, 2);
const double h = grid.resolution();

/// J = int_material (2 - q) with q >= 0 of period one sector, q = 0 at its centre: at a given measure the
/// best hole is bounded by a level line of q.
struct Bowl {
  double centre_radius = 0.27, centre_azimuth = std::numbers::pi / 16, length = 0.03, depth = 0.4;

  double wave(double azimuth) const { return std::cos(grid.n_sectors * (azimuth - centre_azimuth)); }
  double q(double radius, double azimuth) const {
    const double offset = (radius - centre_radius) / length;
    return offset * offset + depth * (1 - wave(azimuth));
  }
  /// int_{R_i}^r (2 - q) r dr: r times the radial field whose divergence is 2 - q.
  double flux(double radius, double wave_value) const {
    const auto antiderivative = [&](double r) {
      const double c = centre_radius;
      const double square =
          (r * r * r * r / 4 - 2 * c * r * r * r / 3 + c * c * r * r / 2) / (length * length);
      return (2 - depth * (1 - wave_value)) * r * r / 2 - square;
    };
    return antiderivative(radius) - antiderivative(grid.inner_radius);
  }
};

/// Radius and azimuth of a boundary sample.
Vec<2> polar_of(const SurfaceSample<2>& sample) {
  const auto cell = grid.cell_position(sample.cell);
  const Vec<2> x =
      CellMap<2>(grid, lattice.degree(), cell).position(ShapeFunctions<2>(lattice.degree(), sample.xi));
  return {norm<2>(x), std::atan2(x[1], x[0]) + cell[1] * grid.column_angle()};
}

Evaluation<2> evaluate_bowl(const LevelSet<2>& psi, const Bowl& bowl = {}) {
  double objective = grid.sector_angle() * bowl.flux(grid.outer_radius, 0);
  auto gradient = boundary_samples<2>(psi);
  for (auto& sample : gradient) {
    const Vec<2> x = polar_of(sample);
    const double radial_normal = sample.normal[0] * std::cos(x[1]) + sample.normal[1] * std::sin(x[1]);
    objective += sample.weight * radial_normal * bowl.flux(x[0], bowl.wave(x[1])) / x[0];
    sample.value = 2 - bowl.q(x[0], x[1]);
  }
  return wheelwright::testing::evaluation_with<2>(objective, gradient);
}

Expected<Evaluation<2>> bowl_objective(const LevelSet<2>& psi) { return evaluate_bowl(psi); }

const EvolutionOptions evolution{{ExtensionKind::h1, 2}, 0.04, {{0.005, 1}, {0.005, 1}}, {}};

LevelSet<2> displaced_hole() {
  return make_level_set<2>(lattice, std::vector<Circle>{{0.262, std::numbers::pi / 16 + 0.04, 0.02}});
}

/// Smallest and largest q on the boundary.
std::pair<double, double> range_of_q(const LevelSet<2>& psi) {
  std::vector<double> q;
  for (const auto& sample : boundary_samples<2>(psi)) {
    const Vec<2> x = polar_of(sample);
    q.push_back(Bowl().q(x[0], x[1]));
  }
  const auto [low, high] = std::minmax_element(q.begin(), q.end());
  return {*low, *high};
}

const auto never = [] { return false; };

struct Record {
  std::vector<Trial<2>> trials;
  ShapeOptimizer<2>::Observer observer() {
    return [this](const Trial<2>& trial, const OptimizationState<2>&) { trials.push_back(trial); };
  }
};

TEST(Bowl, HasTheShapeDerivativeThatItReturns) {
  const auto psi = displaced_hole();
  const auto moved = [&](double distance) {
    auto shifted = psi;
    for (double& value : shifted.values) value -= distance;
    return evaluate_bowl(shifted).function("objective").value;
  };
  double derivative = 0;
  for (const auto& sample : evaluate_bowl(psi).gradient("objective"))
    derivative += sample.weight * sample.value;
  const double step = 1e-5;
  EXPECT_NEAR((moved(step) - moved(-step)) / (2 * step), derivative, 1e-4 * derivative);
}

TEST(ShapeOptimizer, ConvergesToTheLevelLineAtConstantMeasure) {
  OptimizerOptions options;
  options.iterations = 200;
  options.smooth_every = 20;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_TRUE(outcome.reason == StopReason::converged || outcome.reason == StopReason::no_descent)
      << to_string(outcome.reason);
  const auto [low, high] = range_of_q(outcome.state->shape);
  EXPECT_LT(high - low, 0.05 * high);
  double last = record.trials.front().evaluation->function("objective").value;
  for (const auto& trial : record.trials) {
    if (trial.verdict != Verdict::accepted) continue;
    EXPECT_LE(trial.evaluation->function("objective").value,
              last + options.accepted_increase * std::abs(last));
    EXPECT_NEAR(trial.measure, outcome.state->target_measure, 1e-6 * trial.measure);
    last = trial.evaluation->function("objective").value;
  }
  RecordProperty("stop", to_string(outcome.reason));
  RecordProperty("q", fmt::format("{} {}", low, high));
  RecordProperty("trials", static_cast<int>(record.trials.size()));
  RecordProperty("iterations", outcome.state->iteration);
}

// The cells that the measure was computed on, for both ways to hold it.
TEST(ShapeOptimizer, PassesOnTheCellsOfEveryShape) {
  for (const auto control : {MeasureControl::exact, MeasureControl::proportional}) {
    OptimizerOptions options;
    options.iterations = 3;
    options.measure_control = control;
    auto points = evolution;
    points.cut_points = 5;
    int shapes = 0;
    const auto evaluate = [&](const CutShape<2>& shape, const Evaluation<2>*) -> Expected<Evaluated<2>> {
      EXPECT_NE(shape.domain, nullptr);
      const auto cells = cut_domain(shape.psi, 5);
      EXPECT_EQ(shape.domain->kinds, cells->kinds);
      EXPECT_EQ(material_measure(*shape.domain, 2), material_measure(*cells, 2));
      ++shapes;
      return Evaluated<2>{*bowl_objective(shape.psi), nullptr};
    };
    const ShapeOptimizer<2> optimizer(lattice, points, options, evaluate);
    Record record;
    optimize<2>(optimizer, displaced_hole(), record.observer(), never);
    EXPECT_GT(shapes, 3);
    for (const auto& trial : record.trials)
      EXPECT_EQ(trial.measure, material_measure(*cut_domain(trial.shape, 5), 2));
  }
}

// With a quadratic model of the objective far fewer shapes are tried than by descent.
TEST(SequentialQuadratic, ConvergesToTheLevelLineInFewTrials) {
  const auto trials_to = [](Method method, double objective, double step,
                            DeformationKind kind = DeformationKind::vector_field) {
    OptimizerOptions options;
    options.method = method;
    options.step = step;
    EvolutionOptions motion = evolution;
    motion.deformation = kind;
    const ShapeOptimizer<2> optimizer(lattice, motion, options,
                                      wheelwright::testing::objective_of_shape<2>(bowl_objective));
    Record record;
    const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
    const auto [low, high] = range_of_q(outcome.state->shape);
    EXPECT_LT(high - low, 0.06 * high) << to_string(method);
    for (const auto& trial : record.trials)
      if (trial.verdict == Verdict::accepted) {
        EXPECT_NEAR(trial.measure, outcome.state->target_measure, 1e-6 * trial.measure);
      }
    const auto reached = std::ranges::find_if(record.trials, [&](const Trial<2>& trial) {
      return trial.evaluation && trial.evaluation->function("objective").value <= objective;
    });
    EXPECT_NE(reached, record.trials.end()) << to_string(method);
    return reached - record.trials.begin();
  };
  OptimizerOptions exact;
  exact.iterations = 200;
  const ShapeOptimizer<2> optimizer(lattice, evolution, exact,
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  const auto best = optimize<2>(optimizer, displaced_hole(), Record().observer(), never);
  const double initial = evaluate_bowl(displaced_hole()).function("objective").value,
               end = best.state->evaluation.function("objective").value;
  const double near = end + 0.01 * (initial - end);
  const auto of_descent = trials_to(Method::descent, near, 0.5);
  for (const auto kind : {DeformationKind::vector_field, DeformationKind::normal_speed})
    EXPECT_LT(trials_to(Method::sequential_quadratic, near, 1.5, kind), of_descent);
}

// A search ends six trials after its last gain of the tolerance, begin it far from the optimum or at it.
// Without a tolerance it continues until no step helps. A restart resets the count.
TEST(SequentialQuadratic, EndsSixTrialsAfterItsLastGain) {
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  const auto optimizer_with = [&](double tolerance) {
    options.tolerance = tolerance;
    return ShapeOptimizer<2>(lattice, evolution, options,
                             wheelwright::testing::objective_of_shape<2>(bowl_objective));
  };
  const auto objective = [](const Trial<2>& trial) { return trial.evaluation->function("objective").value; };
  constexpr double tolerance = 2e-4;
  const auto endless = optimize<2>(optimizer_with(0), displaced_hole(), Record().observer(), never);
  EXPECT_NE(endless.reason, StopReason::converged);
  const double best = endless.state->evaluation.function("objective").value;
  for (const auto& initial : {displaced_hole(), endless.state->shape}) {
    Record record;
    const auto optimizer = optimizer_with(tolerance);
    const auto outcome = optimize<2>(optimizer, initial, record.observer(), never);
    EXPECT_EQ(outcome.reason, StopReason::converged);
    std::size_t last_gain = 0;
    for (std::size_t k = 0; k < record.trials.size(); ++k)
      if (record.trials[k].verdict == Verdict::accepted &&
          objective(record.trials[k]) <
              objective(record.trials[last_gain]) - tolerance * std::abs(objective(record.trials[last_gain])))
        last_gain = k;
    EXPECT_EQ(record.trials.size() - 1 - last_gain, 6u);
    EXPECT_NEAR(objective(record.trials[last_gain]), best, 2 * tolerance * std::abs(best));
    const auto anew = optimizer.restart(*outcome.state, Record().observer());
    EXPECT_FALSE(reason_to_stop(options, *anew));
  }
}

// Over the first shapes, far from the minimum, the objective falls as the method's model predicts.
TEST(SequentialQuadratic, PredictsTheDecreaseOfATrial) {
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  options.step = 0.25;
  options.iterations = 6;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  Record record;
  optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  ASSERT_GT(record.trials.size(), 6u);
  for (std::size_t k = 1; k < record.trials.size(); ++k) {
    const Trial<2>& trial = record.trials[k];
    ASSERT_EQ(trial.verdict, Verdict::accepted);
    const double fall = record.trials[k - 1].evaluation->function("objective").value -
                        trial.evaluation->function("objective").value;
    EXPECT_NEAR(fall, trial.predicted, 0.3 * trial.predicted) << k;
  }
}

// A coefficient that a band holds does not decide how far the others go: a move takes the time 1, in which
// the boundary goes as far as its deformation says. The best hole lies partly in the tread's band.
TEST(SequentialQuadratic, MovesFreePartsFullyIfABandHoldsOthers) {
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  options.iterations = 40;
  options.tolerance = 0;
  options.redistance_every = 0;
  const auto evaluate = [](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    return evaluate_bowl(psi, {.centre_radius = 0.32, .depth = 1});
  };
  double slowest = 1;  // the fastest node that moves, in units of the fastest one with those that are held
  for (const double length : {2.0, 4.0, 8.0}) {
    EvolutionOptions splines = evolution;
    splines.space = ShapeSpace::spline;
    splines.velocity.length = length;
    const Evolver<2> evolver(lattice, splines);
    const auto observe = [&](const Trial<2>&, const OptimizationState<2>& state) {
      const auto move = *SequentialQuadraticProposals<2>(evolver, options, state).move(state.step);
      const double fastest = largest_magnitude(move.velocity);
      EXPECT_NEAR(move.distance * h / fastest, 1, 1e-12);
      const auto with_held = evolver.deformations().speeds(state.shape, move.deformation);
      slowest = std::min(slowest, fastest / largest_magnitude(with_held));
    };
    const ShapeOptimizer<2> optimizer(lattice, splines, options,
                                      wheelwright::testing::objective_of_shape<2>(evaluate));
    optimize<2>(optimizer, displaced_hole(), observe, never);
  }
  EXPECT_LT(slowest, 0.9);
}

/// The bowl with a second function, the measure of the material, between bounds.
auto bowl_with_bounds(Bounds bounds) {
  return [bounds](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    auto evaluation = evaluate_bowl(psi);
    evaluation.functions.push_back({"material",
                                    material_measure(psi),
                                    {},
                                    std::vector<double>(evaluation.boundary.size(), 1.0),
                                    bounds});
    return evaluation;
  };
}

// Before shapes have the final widths an objective may be as large as one of the last two, though not larger
// by the noise: objectives would drift upwards. With the widths, or without any, it is compared with the
// best and the last one, which may still lie above the best.
TEST(SequentialQuadratic, PassesAJumpBeforeTheFinalWidths) {
  const Evolver<2> evolver(lattice, evolution);
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  Evaluation<2> evaluation = evaluate_bowl(displaced_hole());
  evaluation.functions.front().value = 1;
  const auto accepts = [&](const std::vector<double>& history, double objective, FinalWidths widths) {
    std::vector<AcceptedShape> remembered;
    for (const double value : history) remembered.push_back({value});
    const OptimizationState<2> state{.shape = displaced_hole(),
                                     .evaluation = evaluation,
                                     .measure = material_measure(displaced_hole()),
                                     .target_measure = material_measure(displaced_hole()),
                                     .iteration = static_cast<int>(history.size()) - 1,
                                     .step = 1,
                                     .since_redistance = 0,
                                     .since_smoothing = 0,
                                     .memory = {},
                                     .history = remembered,
                                     .final_widths = widths};
    Evaluation<2> of_trial = evaluation;
    of_trial.functions.front().value = objective;
    const SequentialQuadraticProposals<2> proposals(evolver, options, state);
    return proposals.accepts(*proposals.move(1), of_trial);
  };
  const double noise = options.accepted_increase;
  for (const auto& [history, largest] : {std::pair{std::vector<double>{1.2, 0.9, 1.1, 1.0}, 1.1},
                                         {{1.2, 0.9, 1.0, 1.1}, 1.1},
                                         {{1.2, 1.1, 0.9, 1.0}, 1.0},
                                         {{1.2, 1.1, 1.0}, 1.1},
                                         {{1.0}, 1 + noise}}) {
    const double strict = std::max(*std::ranges::min_element(history) + noise, history.back());
    options.final_widths = {.wall = h, .gap = h};
    EXPECT_TRUE(accepts(history, largest - 0.1 * noise, FinalWidths::not_yet));
    EXPECT_FALSE(accepts(history, largest + 0.1 * noise, FinalWidths::not_yet));
    for (const bool have_widths : {true, false}) {
      if (!have_widths) options.final_widths = {};
      const auto widths = have_widths ? FinalWidths::kept : FinalWidths::not_yet;
      EXPECT_TRUE(accepts(history, strict - 0.1 * noise, widths));
      EXPECT_FALSE(accepts(history, strict + 0.1 * noise, widths));
    }
  }
}

// J grows with the measure: the lower bound is active. Where both are stationary, 2 - q is the multiplier all
// along the boundary. The runs begin below the bound, above it, and on it.
TEST(SequentialQuadratic, KeepsABoundWithItsMultiplier) {
  const double initial = material_measure(displaced_hole());
  for (const double share : {0.98, 1.0, 1.015})
    for (const bool is_equality : {false, true}) {
      const double bound = share * initial;
      OptimizerOptions options;
      options.method = Method::sequential_quadratic;
      options.measure_control = MeasureControl::free;
      options.step = 1.5;
      options.iterations = 60;
      Bounds bounds{.lower = bound};
      if (is_equality) bounds.upper = bound;
      const ShapeOptimizer<2> optimizer(
          lattice, evolution, options, wheelwright::testing::objective_of_shape<2>(bowl_with_bounds(bounds)));
      const auto outcome = optimize<2>(optimizer, displaced_hole(), Record().observer(), never);
      const auto states = bound_states(outcome.state->evaluation, outcome.state->memory.multipliers);
      ASSERT_EQ(states.size(), 1u);
      EXPECT_TRUE(states[0].is_kept()) << share << ": " << states[0].name;
      EXPECT_NEAR(outcome.state->measure, bound, 1e-3 * bound) << share;
      const auto [low, high] = range_of_q(outcome.state->shape);
      EXPECT_LT(high - low, 0.08 * high) << share;
      const double expected = 2 - (low + high) / 2;
      EXPECT_NEAR(std::abs(states[0].multiplier), expected, 0.03 * expected) << share;
    }
}

// What a rejected trial found beyond the linearized bound is what the next move makes up for, by the same
// step; if the objective is to blame, there is nothing to make up for.
TEST(SequentialQuadratic, MakesUpForABoundThatCurves) {
  EvolutionOptions splines = evolution;
  splines.space = ShapeSpace::spline;
  const Evolver<2> evolver(lattice, splines);
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  options.measure_control = MeasureControl::free;
  const auto shape = displaced_hole();
  const double measure = material_measure(shape);
  const OptimizationState<2> state{.shape = shape,
                                   .evaluation = *bowl_with_bounds({.lower = measure})(shape),
                                   .measure = measure,
                                   .target_measure = measure,
                                   .iteration = 0,
                                   .step = 0.2,
                                   .since_redistance = 0,
                                   .since_smoothing = 0,
                                   .memory = {},
                                   .history = {{1}}};
  const SequentialQuadraticProposals<2> proposals(evolver, options, state);
  const auto measure_after = [&](const Move<2>& move) {
    return material_measure(*evolver.move(shape, move.velocity, move.distance * h));
  };
  const auto straight = *proposals.move(state.step);
  for (const double missing : {1e-4, 1e-3}) {
    Evaluation<2> found = state.evaluation;  // as predicted, but for a measure that is too small
    found.functions[0].value += straight.objective_change;
    found.functions[1].value = (1 - straight.gaps.front() - missing) * measure;
    const auto bends = proposals.bends(straight, found);
    ASSERT_EQ(bends.size(), 1u);
    EXPECT_NEAR(bends.front(), missing, 1e-12);
    const auto corrected = *proposals.move(state.step, bends);
    EXPECT_LE(corrected.gaps.front(), 1e-9);
    EXPECT_NEAR(measure_after(corrected) - measure_after(straight), missing * measure,
                0.1 * missing * measure);
    found.functions[0].value += 10 * straight.penalties.front() * missing;
    EXPECT_TRUE(proposals.bends(straight, found).empty());
  }
}

// A bound that the optimum keeps anyway has no multiplier; bounds that contradict each other are violated.
TEST(SequentialQuadratic, ReportsInactiveAndInfeasibleBounds) {
  const double initial = material_measure(displaced_hole());
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  options.iterations = 15;
  const auto end = [&](Bounds bounds) {
    const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                      wheelwright::testing::objective_of_shape<2>(bowl_with_bounds(bounds)));
    const auto outcome = optimize<2>(optimizer, displaced_hole(), Record().observer(), never);
    return bound_states(outcome.state->evaluation, outcome.state->memory.multipliers).front();
  };
  // The measure is held at its initial value.
  const BoundState idle = end({.lower = 0.9 * initial});
  EXPECT_TRUE(idle.is_kept());
  EXPECT_EQ(idle.multiplier, 0);
  EXPECT_FALSE(end({.lower = 1.1 * initial}).is_kept());
}

// However little is gained: a search whose bounds are violated has not converged.
TEST(SequentialQuadratic, DoesNotConvergeWhileABoundIsViolated) {
  OptimizerOptions options;
  options.method = Method::sequential_quadratic;
  options.iterations = 15;
  options.tolerance = 1;
  const auto stop = [&](double share) {
    const auto evaluate = bowl_with_bounds({.lower = share * material_measure(displaced_hole())});
    const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                      wheelwright::testing::objective_of_shape<2>(evaluate));
    return optimize<2>(optimizer, displaced_hole(), Record().observer(), never).reason;
  };
  EXPECT_EQ(stop(0.9), StopReason::converged);
  EXPECT_NE(stop(1.1), StopReason::converged);  // the measure is held at its initial value
}

TEST(ShapeOptimizer, ReachesAGivenMeasure) {
  OptimizerOptions options;
  options.iterations = 3;
  options.target_measure = 1.01 * material_measure(displaced_hole());
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::iterations);
  for (const auto& trial : record.trials)
    EXPECT_NEAR(trial.measure, *options.target_measure, 1e-6 * trial.measure);
}

// J falls with the measure here: on the way up it rises from shape to shape.
TEST(ShapeOptimizer, ReachesAFarMeasureByItsRateAndThenOptimizes) {
  const double whole = sector_measure<2>(grid), initial = material_measure(displaced_hole());
  for (const double target : {initial - 0.083 * whole, initial + 0.047 * whole}) {
    OptimizerOptions options;
    options.iterations = 40;
    options.target_measure = target;
    options.measure_rate = 0.02;
    options.tolerance = 1;  // as soon as there are objectives to compare
    const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                      wheelwright::testing::objective_of_shape<2>(bowl_objective));
    Record record;
    const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
    const double most = options.measure_rate * whole;
    const int arrival = static_cast<int>(std::ceil(std::abs(target - initial) / most));
    EXPECT_NEAR(record.trials[0].measure, initial, 1e-12 * whole);
    for (int k = 0; k <= arrival; ++k) {
      const Trial<2>& trial = record.trials[k];
      ASSERT_EQ(trial.verdict, Verdict::accepted);
      EXPECT_EQ(trial.iteration, k);
      const double reached = std::min(k * most, std::abs(target - initial));
      EXPECT_NEAR(trial.measure, initial + std::copysign(reached, target - initial), 1e-5 * initial);
    }
    for (std::size_t k = arrival; k < record.trials.size(); ++k) {
      EXPECT_NEAR(record.trials[k].measure, target, 1e-6 * target);
    }
    const auto objective = [&](int k) { return record.trials[k].evaluation->function("objective").value; };
    EXPECT_EQ(objective(arrival) > objective(0), target > initial);
    EXPECT_EQ(outcome.reason, StopReason::converged);
    EXPECT_EQ(outcome.state->history_begin, arrival);
    EXPECT_EQ(outcome.state->history.front().objective, objective(arrival));
    EXPECT_EQ(outcome.state->iteration, arrival + 10);
    EXPECT_LT(outcome.state->history.back().objective, outcome.state->history.front().objective);
  }
}

// What fails where the measure changes quickly may succeed where it changes slowly; the failure names the
// key.
TEST(ShapeOptimizer, MovesTheMeasureInProportionToTheStep) {
  const double whole = sector_measure<2>(grid), initial = material_measure(displaced_hole());
  double last = initial;
  const auto brittle = [&last, whole](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    const double measure = material_measure(psi);
    if (std::abs(measure - last) > 0.006 * whole) return Failure{FailureReason::newton_stalled, "too much"};
    last = measure;
    return evaluate_bowl(psi);
  };
  OptimizerOptions options;
  options.iterations = 6;
  options.target_measure = initial - 0.1 * whole;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(brittle));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::iterations);
  EXPECT_TRUE(is_approaching(options, *outcome.state));
  double before = initial;
  int failures = 0;
  for (const auto& trial : record.trials) {
    EXPECT_NEAR(before - trial.measure, options.measure_rate * whole * trial.step / options.step,
                1e-5 * whole);
    if (trial.verdict == Verdict::accepted)
      before = trial.measure;
    else
      ++failures;
    if (trial.failure) {
      EXPECT_NE(trial.failure->detail.find("volume.target"), std::string::npos);
    }
  }
  EXPECT_GE(failures, 2);
}

// A target that the first shape reaches, and does not survive.
TEST(ShapeOptimizer, NamesTheTargetOfAFailedStart) {
  const double initial = material_measure(displaced_hole());
  const auto brittle = [initial](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    if (material_measure(psi) < 0.995 * initial) return Failure{FailureReason::no_contact, ""};
    return evaluate_bowl(psi);
  };
  OptimizerOptions options;
  options.iterations = 0;
  for (const double share : {0.99, 0.98}) {  // the second is not in reach
    options.target_measure = share * initial;
    const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                      wheelwright::testing::objective_of_shape<2>(brittle));
    const auto outcome = optimize<2>(optimizer, displaced_hole(), Record().observer(), never);
    EXPECT_EQ(outcome.reason, share == 0.99 ? StopReason::failed_start : StopReason::iterations);
    if (outcome.failure) {
      EXPECT_NE(outcome.failure->detail.find("volume.target"), std::string::npos);
    }
  }
}

TEST(ShapeOptimizer, FollowsThePapersRule) {
  OptimizerOptions options;
  options.iterations = 18;  // later the growing holes would join all round
  options.tolerance = 0;
  options.measure_control = MeasureControl::proportional;
  auto harmonic = evolution;
  harmonic.velocity.kind = ExtensionKind::harmonic;
  const ShapeOptimizer<2> optimizer(lattice, harmonic, options,
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::iterations);
  EXPECT_EQ(record.trials.size(), 19u);
  for (std::size_t k = 1; k < record.trials.size(); ++k) {
    EXPECT_EQ(record.trials[k].verdict, Verdict::accepted)
        << (record.trials[k].failure ? record.trials[k].failure->detail : "");
    EXPECT_EQ(record.trials[k].step, options.step);
  }
  // The density is positive on the whole boundary: the multiplier leaves an offset.
  EXPECT_LT(outcome.state->measure, outcome.state->target_measure);
  RecordProperty("measure_ratio",
                 ::testing::PrintToString(outcome.state->measure / outcome.state->target_measure));
}

TEST(ShapeOptimizer, HalvesTheStepWhereTheEvaluationFails) {
  std::vector<double> last = displaced_hole().values;
  const auto fragile = [&last](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    double change = 0;
    for (std::size_t k = 0; k < last.size(); ++k)
      change = std::max(change, std::abs(psi.values[k] - last[k]));
    if (change > 0.2 * h) return Failure{FailureReason::newton_stalled, "the shape moved too far"};
    last = psi.values;
    return evaluate_bowl(psi);
  };
  OptimizerOptions options;
  options.iterations = 8;
  options.redistance_every = 0;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(fragile));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::iterations);
  int failures = 0;
  for (const auto& trial : record.trials) {
    if (trial.verdict == Verdict::accepted) continue;
    ++failures;
    EXPECT_EQ(trial.verdict, Verdict::failed);
    EXPECT_EQ(trial.failure->reason, FailureReason::newton_stalled);
    EXPECT_FALSE(trial.evaluation);
  }
  EXPECT_GE(failures, 1);
  EXPECT_LT(outcome.state->evaluation.function("objective").value, outcome.state->history.front().objective);
}

/// The bowl at shapes whose values differ from the first one's by no more than this, a failure elsewhere.
auto bowl_near_the_first(double farthest) {
  return
      [farthest, first = std::vector<double>()](const LevelSet<2>& psi) mutable -> Expected<Evaluation<2>> {
        if (first.empty()) first = psi.values;
        double change = 0;
        for (std::size_t k = 0; k < first.size(); ++k)
          change = std::max(change, std::abs(psi.values[k] - first[k]));
        if (change > farthest) return Failure{FailureReason::no_contact, "too far"};
        return evaluate_bowl(psi);
      };
}

TEST(ShapeOptimizer, GivesUpWhereEveryTrialFails) {
  OptimizerOptions options;
  options.max_halvings = 3;
  const ShapeOptimizer<2> optimizer(
      lattice, evolution, options,
      wheelwright::testing::objective_of_shape<2>(bowl_near_the_first(0.05 * h)));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::gave_up);
  EXPECT_EQ(outcome.state->iteration, 0);
  ASSERT_EQ(record.trials.size(), 5u);
  EXPECT_EQ(record.trials.back().step, options.step / 8);
}

// Widths are a limit of the search: a run that cannot leave a shape because of them has found its end.
TEST(ShapeOptimizer, EndsIfEveryTrialIsTooNarrow) {
  for (const auto reason : {FailureReason::too_narrow, FailureReason::no_contact}) {
    auto near_the_first = bowl_near_the_first(0.05 * h);
    const auto evaluate = [=](const LevelSet<2>& psi) mutable -> Expected<Evaluation<2>> {
      auto evaluation = near_the_first(psi);
      if (!evaluation) return Failure{reason, "a wall"};
      return evaluation;
    };
    OptimizerOptions options;
    options.max_halvings = 3;
    const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                      wheelwright::testing::objective_of_shape<2>(evaluate));
    Record record;
    const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
    EXPECT_EQ(outcome.reason,
              reason == FailureReason::too_narrow ? StopReason::no_descent : StopReason::gave_up);
    EXPECT_EQ(outcome.state->iteration, 0);
    EXPECT_EQ(record.trials.size(), 5u);
  }
}

// A failure of the shape that does not move is no matter of the step.
TEST(ShapeOptimizer, HalvesTheStepInVainOnlyWhereTheShapeAtRestCanBeComputed) {
  const auto only_once = [calls = 0](const LevelSet<2>& psi) mutable -> Expected<Evaluation<2>> {
    if (calls++ > 0) return Failure{FailureReason::no_contact, "nothing there"};
    return evaluate_bowl(psi);
  };
  OptimizerOptions options;
  options.max_halvings = 20;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(only_once));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::gave_up);
  EXPECT_EQ(outcome.state->iteration, 0);
  ASSERT_EQ(record.trials.size(), 5u);
  const Trial<2>& last = record.trials.back();
  EXPECT_EQ(last.step, 0);
  EXPECT_EQ(last.halvings, 3);
  EXPECT_EQ(last.failure->reason, FailureReason::no_contact);
  EXPECT_TRUE(last.failure->detail.starts_with("nothing there"));
}

// Shapes that were evaluated, and rejected, do not make up for one that cannot be.
TEST(ShapeOptimizer, GivesUpWhereTheShapeAtRestFailsAfterARise) {
  const auto worse_then_none = [calls = 0](const LevelSet<2>& psi) mutable -> Expected<Evaluation<2>> {
    if (calls > 2) return Failure{FailureReason::newton_stalled, "no way"};
    auto evaluation = evaluate_bowl(psi);
    evaluation.functions[0].value += 0.1 * calls++ * std::abs(evaluation.functions[0].value);
    return evaluation;
  };
  const ShapeOptimizer<2> optimizer(lattice, evolution, {},
                                    wheelwright::testing::objective_of_shape<2>(worse_then_none));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::gave_up);
  ASSERT_EQ(record.trials.size(), 5u);
  EXPECT_EQ(record.trials[1].verdict, Verdict::objective_rose);
  EXPECT_EQ(record.trials[2].verdict, Verdict::objective_rose);
  EXPECT_EQ(record.trials[4].step, 0);
}

TEST(ShapeOptimizer, RejectsAnIncreaseOfTheObjective) {
  const auto uphill = [](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    auto evaluation = evaluate_bowl(psi);
    for (double& value : evaluation.functions[0].gradient) value = -value;
    return evaluation;
  };
  OptimizerOptions options;
  options.accepted_increase = 0;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(uphill));
  Record record;
  const auto outcome = optimize<2>(optimizer, displaced_hole(), record.observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::no_descent);
  EXPECT_EQ(record.trials.back().verdict, Verdict::objective_rose);
}

TEST(ShapeOptimizer, NamesAFailedStart) {
  const auto failing = [](const LevelSet<2>&) -> Expected<Evaluation<2>> {
    return Failure{FailureReason::disconnected_material, "x"};
  };
  const ShapeOptimizer<2> optimizer(lattice, evolution, {},
                                    wheelwright::testing::objective_of_shape<2>(failing));
  const auto outcome = optimize<2>(optimizer, displaced_hole(), Record().observer(), never);
  EXPECT_EQ(outcome.reason, StopReason::failed_start);
  EXPECT_FALSE(outcome.state);
  EXPECT_EQ(outcome.failure->reason, FailureReason::disconnected_material);
}

TEST(ShapeOptimizer, TreatsANonFiniteObjectiveAsAFailure) {
  const auto not_a_number = [](const LevelSet<2>& psi) -> Expected<Evaluation<2>> {
    auto evaluation = evaluate_bowl(psi);
    evaluation.functions[0].value = std::nan("");
    return evaluation;
  };
  const ShapeOptimizer<2> optimizer(lattice, evolution, {},
                                    wheelwright::testing::objective_of_shape<2>(not_a_number));
  const auto outcome = optimize<2>(optimizer, displaced_hole(), Record().observer(), never);
  EXPECT_EQ(outcome.failure->reason, FailureReason::not_finite);
}

void expect_resumes_a_copy_bit_for_bit(Method method) {
  OptimizerOptions options;
  options.method = method;
  options.iterations = 40;
  options.redistance_every = 3;
  options.smooth_every = 4;
  const ShapeOptimizer<2> optimizer(lattice, evolution, options,
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  std::optional<OptimizationState<2>> copy;
  const auto outcome = optimize<2>(
      optimizer, displaced_hole(),
      [&copy](const Trial<2>&, const OptimizationState<2>& state) {
        if (state.iteration == 5) copy = state;
      },
      never);
  ASSERT_TRUE(copy);
  const ShapeOptimizer<2> another(lattice, evolution, options,
                                  wheelwright::testing::objective_of_shape<2>(bowl_objective));
  EXPECT_EQ(another.run(*copy, Record().observer(), never), outcome.reason);
  EXPECT_EQ(copy->shape.values, outcome.state->shape.values);
  EXPECT_EQ(copy->history, outcome.state->history);
  EXPECT_EQ(copy->step, outcome.state->step);
}

TEST(ShapeOptimizer, ResumesACopyBitForBit) { expect_resumes_a_copy_bit_for_bit(Method::descent); }
TEST(SequentialQuadratic, ResumesACopyBitForBit) {
  expect_resumes_a_copy_bit_for_bit(Method::sequential_quadratic);
}

TEST(ShapeOptimizer, StopsOnRequest) {
  const ShapeOptimizer<2> optimizer(lattice, evolution, {},
                                    wheelwright::testing::objective_of_shape<2>(bowl_objective));
  auto state = optimizer.start(displaced_hole(), Record().observer());
  ASSERT_TRUE(state);
  EXPECT_EQ(optimizer.run(*state, Record().observer(), [&] { return state->iteration == 4; }),
            StopReason::stop_requested);
  EXPECT_EQ(state->iteration, 4);
}

}  // namespace
