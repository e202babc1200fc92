#include "wheelwright/optimization/optimizer/optimizer.h"

#include <algorithm>

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/optimizer/convergence.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/finite.h"

namespace wheelwright {

namespace {

constexpr double step_reduction = 0.5;  // after a rejected trial
constexpr int halvings_before_rest =
    2;  // usually enough; then the step 0 shows whether further ones can help

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

/// A repair tries these widths in turn, until it finds a shape that has them and is not ruined.
template <int dim>
std::vector<FinalWidths> widths_to_try(const OptimizerOptions& options, const OptimizationState<dim>& state) {
  const FinalWidths sharpest = with_sharpest_corners(options);
  if (state.final_widths == sharpest || sharpest == FinalWidths::kept) return {sharpest};
  return {FinalWidths::kept, sharpest};
}

/// Whether a repaired shape has lost holes, or so much of the objective that the search would hardly recover.
template <int dim>
bool is_ruined(const OptimizerOptions& options, const OptimizationState<dim>& state,
               const Trial<dim>& trial) {
  constexpr double much = 0.1;  // of the objective
  if (!trial.evaluation) return false;
  const auto objective_of = [&](const Evaluation<dim>& e) { return e.function(options.objective).value; };
  const double before = objective_of(state.evaluation);
  return objective_of(*trial.evaluation) > before + much * std::abs(before) ||
         std::ranges::find(trial.events, ShapeEventKind::hole_vanished, &ShapeEvent<dim>::kind) !=
             trial.events.end();
}

template <int dim>
bool was_interrupted(const Trial<dim>& trial) {
  return trial.failure && trial.failure->reason == FailureReason::interrupted;
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
    : options_(options), trials_(lattice, evolution, options, std::move(evaluate)) {}

template <int dim>
ShapeOptimizer<dim>::ShapeOptimizer(const PolarGrid<dim>& grid, Setting<dim> setting,
                                    const OptimizerOptions& options, SettingOn<dim> setting_on)
    : options_(options), trials_(grid, std::move(setting), options, std::move(setting_on)) {}

template <int dim>
Expected<ShapeOptimizer<dim>> ShapeOptimizer<dim>::on(const PolarGrid<dim>& grid) const {
  auto trials = trials_.on(grid);
  if (!trials) return trials.failure();
  ShapeOptimizer other = *this;
  other.trials_ = *std::move(trials);
  return other;
}

template <int dim>
ShapeOptimizer<dim> ShapeOptimizer<dim>::with(Evaluate evaluate) const {
  ShapeOptimizer other = *this;
  other.trials_ = trials_.with(std::move(evaluate));
  return other;
}

template <int dim>
Expected<OptimizationState<dim>> ShapeOptimizer<dim>::start(const LevelSet<dim>& initial,
                                                            const Observer& observer) const {
  if (auto failure = check_finite<dim>(initial.lattice, initial.values, "the initial level set"))
    return *failure;
  const Trial<dim> trial = trials_.first(initial);
  if (trial.failure) return *trial.failure;
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
  if (const PolarGrid<dim>& grid = state.shape.lattice.grid(); !trials_.is_on(grid)) {
    const auto there = on(grid);
    return there ? there->restart(state, observer) : Expected<OptimizationState<dim>>(there.failure());
  }
  const Trial<dim> trial = trials_.again(state);
  if (trial.failure) return *trial.failure;
  OptimizationState<dim> next = state;
  next.shape = trial.shape;
  next.measure = trial.measure;
  next.evaluation = *trial.evaluation;
  next.target_measure = options_.target_measure.value_or(state.target_measure);
  next.step = options_.step;
  next.memory = {};
  next.history = {accepted_shape(*trial.evaluation)};
  next.history_begin = state.iteration;
  next.final_widths = first_widths(next.shape);
  observer(trial, next);
  return next;
}

template <int dim>
std::optional<StopReason> ShapeOptimizer<dim>::advance(OptimizationState<dim>& state,
                                                       const Observer& observer,
                                                       const std::function<bool()>& stop_requested) const {
  if (const PolarGrid<dim>& grid = state.shape.lattice.grid(); !trials_.is_on(grid)) {
    const auto there = on(grid);
    if (there) return there->advance(state, observer, stop_requested);
    observer(trials_.without_shape(state, 0, state.step, there.failure()), state);
    return StopReason::gave_up;
  }
  if (state.iteration < options_.iterations && stop_requested()) return StopReason::stop_requested;
  const auto repair = needs_repair(options_, state) || begins_with_sharp_corners(state)
                          ? repair_widths(state, observer)
                          : Repair::nothing;
  if (repair == Repair::interrupted) return StopReason::stop_requested;
  if (repair == Repair::done) return std::nullopt;
  const auto reason = descend(state, observer, stop_requested);
  if ((reason == StopReason::converged || reason == StopReason::no_descent) &&
      has_lost_its_model(options_, state)) {
    state = with_new_model(std::move(state));
    return std::nullopt;
  }
  const bool goes_no_further =
      reason == StopReason::converged || reason == StopReason::no_descent || reason == StopReason::gave_up;
  if (!goes_no_further || !may_be_repaired(options_, state)) return reason;
  // A state that ends here stays as it is: whoever continues from it ends here, too, by the same trials.
  OptimizationState<dim> repaired = state;
  const auto at_last = repair_widths(repaired, observer);
  if (at_last == Repair::interrupted) return StopReason::stop_requested;
  if (at_last != Repair::done) return reason;
  state = std::move(repaired);
  return std::nullopt;
}

/// Gives the state's shape the final widths if it lacks them, or if that fails, those with sharper corners.
/// The run continues from the best of the repaired shapes.
template <int dim>
typename ShapeOptimizer<dim>::Repair ShapeOptimizer<dim>::repair_widths(OptimizationState<dim>& state,
                                                                        const Observer& observer) const {
  const auto ways = widths_to_try(options_, state);
  for (const FinalWidths widths : ways) {
    OptimizationState<dim> next = state;
    next.final_widths = widths;
    if (has_widths(state.shape, trials_.widths_after(next))) {
      state = std::move(next);
      return Repair::nothing;
    }
    std::vector<Trial<dim>> trials = trials_.repaired(next);
    if (widths != ways.back() && is_ruined(options_, state, trials.back())) {
      trials.back().verdict = Verdict::failed;
      trials.back().failure = {FailureReason::too_narrow, "round corners cost too much"};
    }
    if (std::ranges::any_of(trials, was_interrupted<dim>)) return Repair::interrupted;
    for (std::size_t k = 0; k + 1 < trials.size(); ++k) observer(trials[k], state);
    const bool is_possible = trials.back().verdict == Verdict::accepted;
    if (is_possible) state = restarted(std::move(next), trials.back());
    observer(trials.back(), state);
    if (is_possible) return Repair::done;
  }
  state.final_widths = FinalWidths::impossible;
  return Repair::nothing;
}

/// A free descent splits holes that are only about two cells wide into slits that cannot be repaired: a shape
/// with such holes keeps the final widths, with sharper corners, from the start, if it has them. Even sharper
/// corners, which splines produce from small disks, are repaired first.
template <int dim>
FinalWidths ShapeOptimizer<dim>::first_widths(const LevelSet<dim>& shape) const {
  constexpr double small = 1.8, almost = 2.0 / 3;  // of the final widths
  const FinalWidths kept = with_sharpest_corners(options_);
  const FeatureSize widths = enforced_widths(options_, kept);
  const bool has_small_holes =
      widths.gap > 0 && !narrowest_places(shape, {.wall = 0, .gap = small * widths.gap}).empty();
  const FeatureSize needed{.wall = widths.wall, .gap = widths.gap, .radius = almost * widths.radius};
  return has_small_holes && has_widths(shape, needed) ? kept : FinalWidths::not_yet;
}

/// Whether a search that keeps the final widths begins at a shape that does not have them: every shape after
/// it would have to pay for them.
template <int dim>
bool ShapeOptimizer<dim>::begins_with_sharp_corners(const OptimizationState<dim>& state) const {
  constexpr double enough = 0.99;  // of the radius: repaired shapes have it up to a thousandth
  const double radius = enforced_widths(options_, state.final_widths).radius;
  return radius > 0 && state.history.size() == 1 && !has_widths(state.shape, {.radius = enough * radius});
}

template <int dim>
bool ShapeOptimizer<dim>::has_widths(const LevelSet<dim>& shape, const FeatureSize& widths) const {
  return narrowest_places(shape, widths).empty();
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

/// The state without what was learned from earlier shapes, to be searched from as a first one is.
template <int dim>
OptimizationState<dim> ShapeOptimizer<dim>::with_new_model(OptimizationState<dim> state) const {
  state.step = options_.step;
  state.memory.pairs.clear();
  state.history = {state.history.back()};
  state.history_begin = state.iteration;
  return state;
}

template <int dim>
std::optional<StopReason> ShapeOptimizer<dim>::descend(OptimizationState<dim>& state,
                                                       const Observer& observer,
                                                       const std::function<bool()>& stop_requested) const {
  if (const auto reason = reason_to_stop(options_, state)) return reason;
  const auto proposals = proposals_from(evolver(), options_, state);
  if (!proposals) {
    observer(trials_.without_shape(state, 0, state.step, proposals.failure()), state);
    return StopReason::gave_up;
  }
  bool all_failed = true, is_sound = false, may_be_corrected = true;
  double step = state.step;
  std::vector<double> bends;
  // The trial that corrects for bounds is not halved: it does not count.
  for (int halvings = 0; halvings <= options_.max_halvings + (may_be_corrected ? 0 : 1); ++halvings) {
    const auto move = (*proposals)->move(step, bends);
    if (!move) {
      observer(trials_.without_shape(state, halvings, step, move.failure()), state);
      return StopReason::gave_up;
    }
    if (move->step == 0) return StopReason::no_descent;
    const Trial<dim> trial = trials_.moved(state, **proposals, *move, halvings);
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
                              (is_due(options_.redistance_every, state.since_redistance) ||
                               is_due(options_.smooth_every, state.since_smoothing));
    may_be_corrected = may_be_corrected && bends.empty();
    bends = trial.verdict == Verdict::objective_rose && !was_reshaped && may_be_corrected
                ? (*proposals)->bends(*move, *trial.evaluation)
                : std::vector<double>();
    step = was_reshaped || !bends.empty() ? move->radius : step_reduction * move->step;
    if (trial.verdict == Verdict::failed && halvings >= halvings_before_rest && !is_sound) {
      const Trial<dim> at_rest = trials_.at_rest(state, **proposals, *move, halvings + 1);
      if (was_interrupted(at_rest)) return StopReason::stop_requested;
      is_sound = !at_rest.failure;
      if (is_sound) continue;
      observer(at_rest, state);
      return StopReason::gave_up;
    }
  }
  return all_failed ? StopReason::gave_up : StopReason::no_descent;
}

template <int dim>
StopReason ShapeOptimizer<dim>::run(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const {
  while (true)
    if (const auto reason = advance(state, observer, stop_requested)) return *reason;
}

template <int dim>
double ShapeOptimizer<dim>::objective_of(const Evaluation<dim>& evaluation) const {
  return trials_.objective_of(evaluation);
}

template <int dim>
AcceptedShape ShapeOptimizer<dim>::accepted_shape(const Evaluation<dim>& evaluation) const {
  return {.objective = objective_of(evaluation),
          .violation = largest_violation(bound_constraints(evaluation))};
}

template <int dim>
OptimizationState<dim> ShapeOptimizer<dim>::successor(const OptimizationState<dim>& state,
                                                      const Proposals<dim>& proposals, const Move<dim>& move,
                                                      const Trial<dim>& trial) const {
  const auto evolver = trials_.evolver_of(trial.shape.lattice.grid());
  const bool waits = options_.method == Method::descent && trial.halvings > 0;
  const auto count = [&](int every, int since) { return !waits && is_due(every, since) ? 0 : since + 1; };
  OptimizationState<dim> next{.shape = trial.shape,
                              .evaluation = *trial.evaluation,
                              .measure = trial.measure,
                              .target_measure = state.target_measure,
                              .iteration = trial.iteration,
                              .step = proposals.next_step(move, *trial.evaluation),
                              .since_redistance = count(options_.redistance_every, state.since_redistance),
                              .since_smoothing = count(options_.smooth_every, state.since_smoothing),
                              .memory = proposals.remembered(move, trial.shape, *trial.evaluation, *evolver),
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
