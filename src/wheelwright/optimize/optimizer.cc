#include "wheelwright/optimize/optimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "wheelwright/cut/measure.h"
#include "wheelwright/evolution/volume.h"
#include "wheelwright/geometry/finite.h"
#include "wheelwright/geometry/place.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/optimize/constraints.h"
#include "wheelwright/optimize/convergence.h"

namespace wheelwright {

namespace {

constexpr double step_reduction = 0.5;  // after a rejected trial
constexpr int max_removals = 4;
constexpr int halvings_before_rest =
    2;  // usually enough; then the step 0 shows whether further ones can help
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Quadratic steps require shapes whose motion can be predicted.
EvolutionOptions in_space_of(Method method, EvolutionOptions evolution) {
  evolution.space = method == Method::sequential_quadratic ? ShapeSpace::spline : ShapeSpace::nodal;
  return evolution;
}

template <class Points>
double boundary_measure(const Points& points) {
  double sum = 0;
  for (const auto& point : points) sum += point.weight;
  return sum;
}

template <int dim>
bool is_finite(const Evaluation<dim>& evaluation) {
  double sum = 0;
  for (const FunctionValue& function : evaluation.functions) {
    sum += function.value;
    for (size_t q = 0; q < evaluation.boundary.size(); ++q)
      sum += evaluation.boundary[q].weight * function.gradient[q];
  }
  return std::isfinite(sum);
}

/// Whether there are final widths that the state's shape may not have.
template <int dim>
bool may_be_repaired(const OptimizerOptions& options, const OptimizationState<dim>& state) {
  return options.final_widths.any() && state.final_widths == FinalWidths::not_yet &&
         !is_approaching(options, state);
}

/// Whether the descent is slow, or only a third of the shapes is left.
template <int dim>
bool needs_repair(const OptimizerOptions& options, const OptimizationState<dim>& state) {
  constexpr double slow = 5e-3;
  const bool is_last_part = 3 * (options.iterations - state.iteration) <= options.iterations;
  return may_be_repaired(options, state) && state.iteration < options.iterations &&
         (is_last_part || is_slow(options, std::max(slow, options.tolerance), state.history,
                                  !bound_constraints(state.evaluation).empty()));
}

template <int dim>
double merit_of(const Evaluation<dim>& evaluation, const std::string& objective,
                std::vector<double> penalties) {
  const auto constraints = bound_constraints(evaluation);
  const double value = evaluation.function(objective).value;
  if (penalties.size() != constraints.size()) penalties.assign(constraints.size(), std::abs(value));
  return merit(value, constraints, penalties);
}

/// A change of the objective is a jump if it exceeds this multiple of what the gradient predicts and also
/// this factor: near a minimum the gradient predicts nothing.
constexpr double largest_surprise = 3, largest_factor = 4;

std::optional<Failure> check_jump(double before, double after, double predicted) {
  const auto [small, large] = std::minmax({std::abs(before), std::abs(after)});
  if (std::abs(after - before) <= largest_surprise * std::abs(predicted) || large <= largest_factor * small)
    return {};
  return Failure{FailureReason::objective_jumped,
                 fmt::format("the objective changed from {:.6g} to {:.6g}, but its gradient predicted {:.6g}",
                             before, after, before + predicted)};
}

/// A trial that does not have its own shape yet.
template <int dim>
Trial<dim> failed_trial(const OptimizationState<dim>& state, int halvings, double step,
                        std::optional<Failure> failure) {
  return {.iteration = state.iteration + 1,
          .halvings = halvings,
          .step = step,
          .max_velocity = unknown,
          .evolution_seconds = 0,
          .shape = state.shape,
          .measure = unknown,
          .verdict = Verdict::failed,
          .failure = std::move(failure)};
}

/// The trial of an unmoved shape.
template <int dim>
Trial<dim> trial_at_rest(int iteration, LevelSet<dim> shape) {
  return {.iteration = iteration,
          .halvings = 0,
          .step = 0,
          .max_velocity = 0,
          .evolution_seconds = 0,
          .shape = std::move(shape),
          .measure = unknown,
          .verdict = Verdict::failed};
}

template <int dim>
bool was_interrupted(const Trial<dim>& trial) {
  return trial.failure && trial.failure->reason == FailureReason::interrupted;
}

/// Stores a stage's result as the trial's shape, or its failure as the trial's; returns whether it is a
/// shape.
template <int dim>
bool store(Expected<LevelSet<dim>> shape, Trial<dim>& trial) {
  if (shape)
    trial.shape = *std::move(shape);
  else
    trial.failure = shape.failure();
  return !trial.failure;
}

/// The same; the shape's cells.
template <int dim>
std::optional<CutDomain<dim>> store(Expected<MeasuredShape<dim>> measured, Trial<dim>& trial) {
  if (!measured) {
    trial.failure = measured.failure();
    return {};
  }
  trial.shape = std::move(measured->shape);
  trial.measure = measured->measure;
  return std::move(measured->domain);
}

}  // namespace

template <int dim>
bool is_approaching(const OptimizerOptions& options, const OptimizationState<dim>& state) {
  return options.measure_control == MeasureControl::exact &&
         std::abs(state.measure - state.target_measure) > measure_tolerance * state.target_measure;
}

template <int dim>
double next_measure(const OptimizerOptions& options, const OptimizationState<dim>& state, double step) {
  const double most =
      options.measure_rate * sector_measure<dim>(state.shape.lattice.grid()) * step / options.step;
  return std::clamp(state.target_measure, state.measure - most, state.measure + most);
}

template <int dim>
std::optional<StopReason> reason_to_stop(const OptimizerOptions& options,
                                         const OptimizationState<dim>& state) {
  if (state.iteration >= options.iterations) return StopReason::iterations;
  if (has_converged(options, state)) return StopReason::converged;
  return {};
}

template <int dim>
ShapeOptimizer<dim>::ShapeOptimizer(const Lattice<dim>& lattice, const EvolutionOptions& evolution,
                                    const OptimizerOptions& options, Evaluate evaluate)
    : lattice_(lattice),
      evolver_(lattice, in_space_of(options.method, evolution)),
      options_(options),
      evaluate_(std::move(evaluate)) {}

template <int dim>
Expected<OptimizationState<dim>> ShapeOptimizer<dim>::start(const LevelSet<dim>& initial,
                                                            const Observer& observer) const {
  if (auto failure = check_finite<dim>(lattice_, initial.values, "the initial level set")) return *failure;
  Trial<dim> trial = trial_at_rest<dim>(0, evolver_.keep_bands(initial));
  const double given = material_measure(trial.shape);
  const auto target = is_in_reach(given) ? options_.target_measure : std::nullopt;
  auto cells =
      finish(trial, target, boundary_measure(boundary_samples<dim>(trial.shape)), evolver_.features());
  if (!trial.failure) evaluate(trial, std::move(cells), nullptr, evolver_.features());
  if (trial.failure) {
    if (target) name_target(given, *target, *target, *trial.failure);
    return *trial.failure;
  }
  trial.verdict = Verdict::accepted;
  add_changes(initial, trial);
  OptimizationState<dim> state{.shape = trial.shape,
                               .evaluation = *trial.evaluation,
                               .measure = trial.measure,
                               .target_measure = options_.target_measure.value_or(trial.measure),
                               .iteration = 0,
                               .step = options_.step,
                               .since_redistance = 0,
                               .since_smoothing = 0,
                               .memory = {},
                               .history = {accepted_shape(*trial.evaluation)}};
  state.final_widths = first_widths(state.shape);
  observer(trial, state);
  return state;
}

template <int dim>
Expected<OptimizationState<dim>> ShapeOptimizer<dim>::restart(const OptimizationState<dim>& state,
                                                              const Observer& observer) const {
  Trial<dim> trial = trial_at_rest<dim>(state.iteration, state.shape);
  evaluate(trial, {}, nullptr, evolver_.features());
  if (trial.failure) return *trial.failure;
  trial.verdict = Verdict::accepted;
  OptimizationState<dim> anew = state;
  anew.shape = trial.shape;
  anew.measure = trial.measure;
  anew.evaluation = *trial.evaluation;
  anew.target_measure = options_.target_measure.value_or(state.target_measure);
  anew.step = options_.step;
  anew.memory = {};
  anew.history = {accepted_shape(*trial.evaluation)};
  anew.history_begin = state.iteration;
  anew.final_widths = first_widths(anew.shape);
  observer(trial, anew);
  return anew;
}

template <int dim>
std::optional<StopReason> ShapeOptimizer<dim>::advance(OptimizationState<dim>& state,
                                                       const Observer& observer,
                                                       const std::function<bool()>& stop_requested) const {
  if (state.iteration < options_.iterations && stop_requested()) return StopReason::stop_requested;
  const auto repair = needs_repair(options_, state) ? repair_widths(state, observer) : Repair::nothing;
  if (repair == Repair::interrupted) return StopReason::stop_requested;
  if (repair == Repair::done) return std::nullopt;
  const auto reason = descend(state, observer, stop_requested);
  const bool goes_no_further =
      reason == StopReason::converged || reason == StopReason::no_descent || reason == StopReason::gave_up;
  if (!goes_no_further || !may_be_repaired(options_, state)) return reason;
  const auto at_last = repair_widths(state, observer);
  if (at_last == Repair::interrupted) return StopReason::stop_requested;
  return at_last == Repair::done ? std::nullopt : reason;
}

/// Gives the state's shape the final widths if it lacks them. The run continues from the best of the repaired
/// shapes.
template <int dim>
typename ShapeOptimizer<dim>::Repair ShapeOptimizer<dim>::repair_widths(OptimizationState<dim>& state,
                                                                        const Observer& observer) const {
  OptimizationState<dim> next = state;
  next.final_widths = FinalWidths::kept;
  if (has_widths(state.shape, widths_after(next))) {
    state = std::move(next);
    return Repair::nothing;
  }
  const std::vector<Trial<dim>> trials = repaired(next);
  if (std::ranges::any_of(trials, was_interrupted<dim>)) return Repair::interrupted;
  const bool is_possible = trials.back().verdict == Verdict::accepted;
  if (!is_possible) state.final_widths = FinalWidths::impossible;
  for (std::size_t k = 0; k + 1 < trials.size(); ++k) observer(trials[k], state);
  if (is_possible) state = restarted(std::move(next), trials.back());
  observer(trials.back(), state);
  return is_possible ? Repair::done : Repair::nothing;
}

/// A free descent splits holes that are only about two cells wide into slits that cannot be repaired: a shape
/// with such holes keeps the final widths from the start, if it has them. Slightly sharper corners, which
/// splines produce from small disks, are rounded in the next shape.
template <int dim>
FinalWidths ShapeOptimizer<dim>::first_widths(const LevelSet<dim>& shape) const {
  constexpr double small = 1.8, almost = 2.0 / 3;  // of the final widths
  const FeatureSize& widths = options_.final_widths;
  const bool has_small_holes =
      widths.gap > 0 && !narrowest_places(shape, {.wall = 0, .gap = small * widths.gap}).empty();
  const FeatureSize needed{.wall = widths.wall, .gap = widths.gap, .radius = almost * widths.radius};
  return has_small_holes && has_widths(shape, needed) ? FinalWidths::kept : FinalWidths::not_yet;
}

template <int dim>
bool ShapeOptimizer<dim>::has_widths(const LevelSet<dim>& shape, const FeatureSize& widths) const {
  return narrowest_places(shape, widths).empty();
}

/// The state's shape with the widths of the following shapes, repaired in two ways: with its thin walls
/// thickened, and with them removed. The better one comes last, and is accepted if it could be evaluated.
template <int dim>
std::vector<Trial<dim>> ShapeOptimizer<dim>::repaired(const OptimizationState<dim>& state) const {
  const FeatureSize widths = widths_after(state);
  std::vector<Trial<dim>> trials{repaired(state, state.shape)};
  const LevelSet<dim> cut = without_thin_walls(state.shape, widths.wall);
  if (cut.values != state.shape.values) trials.push_back(repaired(state, cut));
  const auto merit_or_worst = [&](const Trial<dim>& trial) {
    return trial.failure ? std::numeric_limits<double>::infinity()
                         : merit_of(*trial.evaluation, options_.objective, state.memory.penalties);
  };
  std::ranges::stable_sort(trials, std::greater<>(), merit_or_worst);
  for (std::size_t k = 0; k < trials.size(); ++k) trials[k].halvings = static_cast<int>(k);
  Trial<dim>& best = trials.back();
  if (best.failure) return trials;
  best.verdict = Verdict::accepted;
  for (const auto& event : narrowest_places(state.shape, widths)) best.events.push_back(event);
  add_changes(state.shape, best);
  return trials;
}

/// The trial of a shape with the widths of the shapes after the state.
template <int dim>
Trial<dim> ShapeOptimizer<dim>::repaired(const OptimizationState<dim>& state,
                                         const LevelSet<dim>& shape) const {
  const auto start = std::chrono::steady_clock::now();
  Trial<dim> trial = trial_at_rest<dim>(state.iteration + 1, evolver_.keep_bands(shape));
  auto cells =
      finish(trial, state.target_measure, boundary_measure(state.evaluation.boundary), widths_after(state));
  trial.evolution_seconds = seconds_since(start);
  if (!trial.failure) evaluate(trial, std::move(cells), &state.evaluation, widths_after(state));
  trial.verdict = trial.failure ? Verdict::failed : Verdict::objective_rose;
  return trial;
}

/// The state at the trial's shape, whose objective is not compared with those before.
template <int dim>
OptimizationState<dim> ShapeOptimizer<dim>::restarted(OptimizationState<dim> state,
                                                      const Trial<dim>& trial) const {
  state.shape = trial.shape;
  state.evaluation = *trial.evaluation;
  state.measure = trial.measure;
  state.iteration = trial.iteration;
  state.step = options_.step;
  ++state.since_redistance;
  ++state.since_smoothing;
  state.history = {accepted_shape(*trial.evaluation)};
  state.history_begin = trial.iteration;
  return state;
}

template <int dim>
FeatureSize ShapeOptimizer<dim>::widths_after(const OptimizationState<dim>& state) const {
  return wheelwright::widths_after(evolver_.features(), options_, state);
}

template <int dim>
std::optional<StopReason> ShapeOptimizer<dim>::descend(OptimizationState<dim>& state,
                                                       const Observer& observer,
                                                       const std::function<bool()>& stop_requested) const {
  if (const auto reason = reason_to_stop(options_, state)) return reason;
  const auto proposals = proposals_from(evolver_, options_, state);
  if (!proposals) {
    observer(failed_trial(state, 0, state.step, proposals.failure()), state);
    return StopReason::gave_up;
  }
  bool all_failed = true, is_sound = false;
  double step = state.step;
  for (int halvings = 0; halvings <= options_.max_halvings; ++halvings) {
    const auto move = (*proposals)->move(step);
    if (!move) {
      observer(failed_trial(state, halvings, step, move.failure()), state);
      return StopReason::gave_up;
    }
    if (move->step == 0) return StopReason::no_descent;
    const Trial<dim> trial = attempt(state, **proposals, *move, halvings);
    if (was_interrupted(trial)) return StopReason::stop_requested;
    if (trial.verdict == Verdict::accepted) state = successor(state, **proposals, *move, trial);
    observer(trial, state);
    if (trial.verdict == Verdict::accepted) return std::nullopt;
    // A shape that cannot have its widths is rejected, but is not an error.
    const bool is_narrow = trial.failure && trial.failure->reason == FailureReason::too_narrow;
    all_failed =
        all_failed && trial.verdict == Verdict::failed && (!is_narrow || is_approaching(options_, state));
    if (!all_failed && has_converged(options_, state, halvings + 1) &&
        !predicts_gain(options_, state, move->model_decrease))
      return StopReason::converged;
    if (stop_requested()) return StopReason::stop_requested;
    // A trial spoilt by redistancing or smoothing is repeated without them.
    const bool was_reshaped = halvings == 0 && options_.method == Method::sequential_quadratic &&
                              (is_due(options_.redistance_every, state.since_redistance, 0) ||
                               is_due(options_.smooth_every, state.since_smoothing, 0));
    step = was_reshaped ? move->radius : step_reduction * move->step;
    if (trial.verdict == Verdict::failed && halvings >= halvings_before_rest && !is_sound) {
      const Trial<dim> at_rest = attempt_at_rest(state, **proposals, *move, halvings + 1);
      if (was_interrupted(at_rest)) return StopReason::stop_requested;
      is_sound = !at_rest.failure;
      if (is_sound) continue;
      observer(at_rest, state);
      return StopReason::gave_up;
    }
  }
  return all_failed ? StopReason::gave_up : StopReason::no_descent;
}

/// A trial of the step 0: what fails there fails with every smaller step.
template <int dim>
Trial<dim> ShapeOptimizer<dim>::attempt_at_rest(const OptimizationState<dim>& state,
                                                const Proposals<dim>& proposals, Move<dim> move,
                                                int halvings) const {
  move.distance = 0;
  move.step = 0;
  move.measure = state.measure;
  move.objective_change = 0;
  move.model_decrease = 0;
  Trial<dim> trial = attempt(state, proposals, move, halvings);
  if (trial.failure)
    trial.failure->detail += "; it fails even if the boundary does not move, so no smaller step helps";
  return trial;
}

template <int dim>
StopReason ShapeOptimizer<dim>::run(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const {
  while (true)
    if (const auto reason = advance(state, observer, stop_requested)) return *reason;
}

template <int dim>
double ShapeOptimizer<dim>::objective_of(const Evaluation<dim>& evaluation) const {
  return evaluation.function(options_.objective).value;
}

template <int dim>
AcceptedShape ShapeOptimizer<dim>::accepted_shape(const Evaluation<dim>& evaluation) const {
  return {.objective = objective_of(evaluation),
          .violation = largest_violation(bound_constraints(evaluation))};
}

template <int dim>
Trial<dim> ShapeOptimizer<dim>::attempt(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                                        const Move<dim>& move, int halvings) const {
  const auto start = std::chrono::steady_clock::now();
  Trial<dim> trial = failed_trial(state, halvings, move.step, {});
  trial.max_velocity = largest_magnitude(move.velocity);
  trial.predicted = move.model_decrease;
  auto cells = evolve(state, move, trial);
  trial.evolution_seconds = seconds_since(start);
  if (!trial.failure) evaluate(trial, std::move(cells), &state.evaluation, widths_after(state));
  if (!trial.failure)
    trial.failure =
        check_jump(objective_of(state.evaluation), objective_of(*trial.evaluation), move.objective_change);
  if (trial.failure) {
    name_target(state.measure, move.measure, state.target_measure, *trial.failure);
    return trial;
  }
  trial.verdict = proposals.accepts(move, *trial.evaluation) ? Verdict::accepted : Verdict::objective_rose;
  if (trial.verdict == Verdict::accepted) add_changes(state.shape, trial);
  return trial;
}

/// Adds to the failure of a trial that its measure was to change, if it was [m^2, or m^3 when dim = 3].
template <int dim>
void ShapeOptimizer<dim>::name_target(double from, double to, double target, Failure& failure) const {
  if (options_.measure_control != MeasureControl::exact || failure.reason == FailureReason::interrupted ||
      std::abs(to - from) <= measure_tolerance * target)
    return;
  const double whole = sector_measure<dim>(lattice_.grid());
  failure.detail += fmt::format(
      "; the volume was to change from {:.6g} to {:.6g} of the ring, on its way to volume.target = {:.6g}: "
      "choose a target closer to these, or a smaller volume.rate",
      from / whole, to / whole, target / whole);
}

/// Whether one full step brings this measure to the given target.
template <int dim>
bool ShapeOptimizer<dim>::is_in_reach(double measure) const {
  const double most = options_.measure_rate * sector_measure<dim>(lattice_.grid());
  return options_.target_measure && std::abs(*options_.target_measure - measure) <= most;
}

/// Builds the trial's shape from the state's; if a stage fails, the shape remains that of the stage before.
template <int dim>
typename ShapeOptimizer<dim>::MadeCells ShapeOptimizer<dim>::evolve(const OptimizationState<dim>& state,
                                                                    const Move<dim>& move,
                                                                    Trial<dim>& trial) const {
  const bool redistances = is_due(options_.redistance_every, state.since_redistance, trial.halvings),
             smooths = is_due(options_.smooth_every, state.since_smoothing, trial.halvings);
  if (store(evolver_.move(state.shape, move.velocity, move.distance * lattice_.grid().resolution()), trial) &&
      (!redistances || store(evolver_.redistance(trial.shape), trial)) &&
      (!smooths || store(evolver_.smooth(trial.shape), trial)))
    return finish(trial, move.measure, boundary_measure(state.evaluation.boundary), widths_after(state));
  return {};
}

/// Gives the trial's shape the target measure, if that is controlled exactly, and removes islands;
/// repeatedly, because the shift compensates for removed islands and can create new ones.
template <int dim>
typename ShapeOptimizer<dim>::MadeCells ShapeOptimizer<dim>::finish(Trial<dim>& trial,
                                                                    std::optional<double> target,
                                                                    double boundary_measure,
                                                                    const FeatureSize& widths) const {
  const double largest = options_.largest_island * sector_measure<dim>(lattice_.grid());
  for (int k = 0; k < max_removals; ++k) {
    trial.measure = unknown;
    MadeCells cells;
    if (target && options_.measure_control == MeasureControl::exact)
      cells = store(evolver_.with_measure(trial.shape, *target, boundary_measure, widths), trial);
    if (trial.failure) return {};
    auto attached = evolver_.without_islands(trial.shape, largest);
    if (!attached) {
      trial.failure = attached.failure();
      return {};
    }
    if (attached->removed.empty()) return cells;
    trial.shape = std::move(attached->psi);
    trial.events.insert(trial.events.end(), attached->removed.begin(), attached->removed.end());
  }
  trial.failure = Failure{FailureReason::disconnected_material,
                          fmt::format("islands reappear whenever they are removed, most recently at {}",
                                      place_text<dim>(trial.events.back().place))};
  return {};
}

template <int dim>
void ShapeOptimizer<dim>::add_changes(const LevelSet<dim>& before, Trial<dim>& trial) const {
  for (const auto& event : evolver_.changes(before, trial.shape)) trial.events.push_back(event);
}

/// Cuts and measures the trial's shape unless the shift to the target has done so.
template <int dim>
void ShapeOptimizer<dim>::evaluate(Trial<dim>& trial, MadeCells cells, const Evaluation<dim>* previous,
                                   const FeatureSize& widths) const {
  if (!cells) cells = store(evolver_.measured(trial.shape, widths), trial);
  if (trial.failure) return;
  auto evaluated = evaluate_({trial.shape, &*cells}, previous);
  if (!evaluated) {
    trial.failure = evaluated.failure();
    return;
  }
  trial.solution = std::move(evaluated->state);
  trial.other_solutions = std::move(evaluated->others);
  if (is_finite(evaluated->evaluation))
    trial.evaluation = std::move(evaluated->evaluation);
  else
    trial.failure = Failure{FailureReason::not_finite, "the objective or its shape gradient"};
}

template <int dim>
bool ShapeOptimizer<dim>::is_due(int every, int since, int halvings) const {
  return every > 0 && since + 1 >= every && halvings == 0;
}

template <int dim>
OptimizationState<dim> ShapeOptimizer<dim>::successor(const OptimizationState<dim>& state,
                                                      const Proposals<dim>& proposals, const Move<dim>& move,
                                                      const Trial<dim>& trial) const {
  const auto count = [&](int every, int since) {
    const bool waits = options_.method == Method::descent && trial.halvings > 0;
    return is_due(every, since, waits ? trial.halvings : 0) ? 0 : since + 1;
  };
  OptimizationState<dim> next{.shape = trial.shape,
                              .evaluation = *trial.evaluation,
                              .measure = trial.measure,
                              .target_measure = state.target_measure,
                              .iteration = trial.iteration,
                              .step = proposals.next_step(move, *trial.evaluation),
                              .since_redistance = count(options_.redistance_every, state.since_redistance),
                              .since_smoothing = count(options_.smooth_every, state.since_smoothing),
                              .memory = proposals.remembered(move, trial.shape, *trial.evaluation),
                              .history = state.history,
                              .history_begin = state.history_begin,
                              .final_widths = state.final_widths};
  next.history.back().trials = trial.halvings + 1;
  if (is_approaching(options_, state)) {
    next.history.clear();
    next.history_begin = next.iteration;
  }
  next.history.push_back(accepted_shape(*trial.evaluation));
  return next;
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

template decltype(is_approaching<2>) is_approaching<2>;
template decltype(is_approaching<3>) is_approaching<3>;
template decltype(next_measure<2>) next_measure<2>;
template decltype(next_measure<3>) next_measure<3>;
template decltype(reason_to_stop<2>) reason_to_stop<2>;
template decltype(reason_to_stop<3>) reason_to_stop<3>;
template class ShapeOptimizer<2>;
template class ShapeOptimizer<3>;
template decltype(optimize<2>) optimize<2>;
template decltype(optimize<3>) optimize<3>;

}  // namespace wheelwright
