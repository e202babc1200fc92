#include "optimize/optimizer.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "cut/measure.h"
#include "evolution/volume.h"

namespace wheelwright {

namespace {

constexpr double step_growth = 1.5;
constexpr double step_reduction = 0.5;
constexpr std::size_t convergence_window = 10;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int dim>
double boundary_measure(std::span<const SurfaceSample<dim>> samples) {
  double sum = 0;
  for (const auto& sample : samples) sum += sample.weight;
  return sum;
}

template <int dim>
bool is_finite(const Evaluation<dim>& evaluation) {
  double sum = evaluation.objective;
  for (const auto& sample : evaluation.gradient) sum += sample.weight * sample.value;
  return std::isfinite(sum);
}

double largest_magnitude(std::span<const double> values) {
  double largest = 0;
  for (double v : values) {
    if (!std::isfinite(v)) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max(largest, std::abs(v));
  }
  return largest;
}

bool is_converged(const OptimizerOptions& options, const std::vector<double>& history) {
  if (options.tolerance <= 0 || history.size() <= convergence_window) return false;
  const double before = history[history.size() - 1 - convergence_window];
  double fall = before - history.back();
  // The paper's rule lets the measure drift, and the objective rise with it.
  if (options.measure_control == MeasureControl::proportional) fall = std::abs(fall);
  return fall < options.tolerance * std::abs(before);
}

}  // namespace

template <int dim>
std::optional<StopReason> reason_to_stop(const OptimizerOptions& options,
                                         const OptimizationState<dim>& state) {
  if (state.iteration >= options.iterations) return StopReason::iterations;
  if (is_converged(options, state.history)) return StopReason::converged;
  return {};
}

template <int dim>
ShapeOptimizer<dim>::ShapeOptimizer(const Lattice<dim>& lattice, const EvolutionOptions& evolution,
                                    const OptimizerOptions& options, Objective objective)
    : lattice_(lattice), evolver_(lattice, evolution), options_(options), objective_(std::move(objective)) {}

template <int dim>
Expected<OptimizationState<dim>> ShapeOptimizer<dim>::start(const LevelSet<dim>& initial,
                                                            const Observer& observer) const {
  LevelSet<dim> shape = evolver_.keep_bands(initial);
  if (options_.target_measure && options_.measure_control == MeasureControl::exact) {
    const auto samples = boundary_samples<dim>(shape);
    auto shifted = evolver_.with_measure(shape, *options_.target_measure, boundary_measure<dim>(samples));
    if (!shifted) return shifted.failure();
    shape = *std::move(shifted);
  }
  Trial<dim> trial{0, 0, 0, 0, 0, std::move(shape), 0, Verdict::failed, {}, {}};
  trial.measure = material_measure(trial.shape);
  evaluate(trial);
  if (trial.failure) return *trial.failure;
  trial.verdict = Verdict::accepted;
  OptimizationState<dim> state{trial.shape,
                               *trial.evaluation,
                               trial.measure,
                               options_.target_measure.value_or(trial.measure),
                               0,
                               options_.step,
                               0,
                               0,
                               {trial.evaluation->objective}};
  observer(trial, state);
  return state;
}

template <int dim>
std::optional<StopReason> ShapeOptimizer<dim>::advance(OptimizationState<dim>& state,
                                                       const Observer& observer,
                                                       const std::function<bool()>& stop_requested) const {
  if (const auto reason = reason_to_stop(options_, state)) return reason;
  if (stop_requested()) return StopReason::stop_requested;
  const auto velocity = descent_velocity(state);
  if (!(largest_magnitude(velocity) > 0)) return StopReason::no_descent;
  for (int halvings = 0; halvings <= options_.max_halvings; ++halvings) {
    const Trial<dim> trial = attempt(state, velocity, halvings);
    if (trial.verdict == Verdict::accepted) state = successor(state, trial);
    observer(trial, state);
    if (trial.verdict == Verdict::accepted) return std::nullopt;
    if (stop_requested()) return StopReason::stop_requested;
  }
  return StopReason::no_descent;
}

template <int dim>
StopReason ShapeOptimizer<dim>::run(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const {
  while (true)
    if (const auto reason = advance(state, observer, stop_requested)) return *reason;
}

template <int dim>
std::vector<double> ShapeOptimizer<dim>::descent_velocity(const OptimizationState<dim>& state) const {
  auto gradient = state.evaluation.gradient;
  if (options_.measure_control == MeasureControl::exact)
    return evolver_.measure_preserving_velocity(gradient);
  const double whole = sector_measure<dim>(lattice_.grid());
  const double multiplier =
      proportional_multiplier<dim>(gradient, state.target_measure / whole, state.measure / whole);
  for (auto& sample : gradient) sample.value -= multiplier;
  return evolver_.velocity(gradient);
}

template <int dim>
Trial<dim> ShapeOptimizer<dim>::attempt(const OptimizationState<dim>& state, std::span<const double> velocity,
                                        int halvings) const {
  const auto start = std::chrono::steady_clock::now();
  const double step = state.step * std::pow(step_reduction, halvings);
  auto shape = evolve(state, velocity, step, halvings);
  Trial<dim> trial{state.iteration + 1,
                   halvings,
                   step,
                   largest_magnitude(velocity),
                   0,
                   shape ? *shape : state.shape,
                   std::numeric_limits<double>::quiet_NaN(),
                   Verdict::failed,
                   {},
                   {}};
  if (shape)
    trial.measure = material_measure(trial.shape);
  else
    trial.failure = shape.failure();
  trial.evolution_seconds = seconds_since(start);
  if (trial.failure) return trial;
  evaluate(trial);
  if (trial.failure) return trial;
  const double best = *std::min_element(state.history.begin(), state.history.end());
  const double bound = best + options_.accepted_increase * std::abs(best);
  const bool accepted =
      options_.measure_control == MeasureControl::proportional || trial.evaluation->objective <= bound;
  trial.verdict = accepted ? Verdict::accepted : Verdict::objective_rose;
  return trial;
}

template <int dim>
Expected<LevelSet<dim>> ShapeOptimizer<dim>::evolve(const OptimizationState<dim>& state,
                                                    std::span<const double> velocity, double step,
                                                    int halvings) const {
  LevelSet<dim> psi = evolver_.move(state.shape, velocity, step * lattice_.grid().resolution());
  if (is_due(options_.redistance_every, state.since_redistance, halvings)) psi = evolver_.redistance(psi);
  if (is_due(options_.smooth_every, state.since_smoothing, halvings)) psi = evolver_.smooth(psi);
  if (options_.measure_control == MeasureControl::proportional) return psi;
  return evolver_.with_measure(psi, state.target_measure, boundary_measure<dim>(state.evaluation.gradient));
}

template <int dim>
void ShapeOptimizer<dim>::evaluate(Trial<dim>& trial) const {
  auto evaluation = objective_(trial.shape);
  if (!evaluation)
    trial.failure = evaluation.failure();
  else if (!is_finite(*evaluation))
    trial.failure = Failure{FailureReason::not_finite, "the objective or its shape gradient"};
  else
    trial.evaluation = *std::move(evaluation);
}

template <int dim>
bool ShapeOptimizer<dim>::is_due(int every, int since, int halvings) const {
  return every > 0 && since + 1 >= every && halvings == 0;
}

/// A step that raised the objective, if within bounds, went past the minimum along its direction.
template <int dim>
double ShapeOptimizer<dim>::next_step(const OptimizationState<dim>& state, const Trial<dim>& trial) const {
  const bool overshot = options_.measure_control == MeasureControl::exact &&
                        trial.evaluation->objective > state.evaluation.objective;
  const double step = trial.step * (overshot ? step_reduction : step_growth);
  return std::clamp(step, std::ldexp(options_.step, -options_.max_halvings), options_.step);
}

template <int dim>
OptimizationState<dim> ShapeOptimizer<dim>::successor(const OptimizationState<dim>& state,
                                                      const Trial<dim>& trial) const {
  const auto count = [&](int every, int since) {
    return is_due(every, since, trial.halvings) ? 0 : since + 1;
  };
  auto history = state.history;
  history.push_back(trial.evaluation->objective);
  return {trial.shape,
          *trial.evaluation,
          trial.measure,
          state.target_measure,
          trial.iteration,
          next_step(state, trial),
          count(options_.redistance_every, state.since_redistance),
          count(options_.smooth_every, state.since_smoothing),
          std::move(history)};
}

template <int dim>
Outcome<dim> optimize(const ShapeOptimizer<dim>& optimizer, const LevelSet<dim>& initial,
                      const typename ShapeOptimizer<dim>::Observer& observer,
                      const std::function<bool()>& stop_requested) {
  auto state = optimizer.start(initial, observer);
  if (!state) return {StopReason::failed_start, {}, state.failure()};
  const StopReason reason = optimizer.run(*state, observer, stop_requested);
  return {reason, *std::move(state), {}};
}

template std::optional<StopReason> reason_to_stop(const OptimizerOptions&, const OptimizationState<2>&);
template std::optional<StopReason> reason_to_stop(const OptimizerOptions&, const OptimizationState<3>&);
template class ShapeOptimizer<2>;
template class ShapeOptimizer<3>;
template Outcome<2> optimize<2>(const ShapeOptimizer<2>&, const LevelSet<2>&,
                                const ShapeOptimizer<2>::Observer&, const std::function<bool()>&);
template Outcome<3> optimize<3>(const ShapeOptimizer<3>&, const LevelSet<3>&,
                                const ShapeOptimizer<3>::Observer&, const std::function<bool()>&);

}  // namespace wheelwright
