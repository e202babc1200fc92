#include "wheelwright/run/run_loop.h"

#include <fmt/format.h>

#include <limits>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/write.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/evolution/regrid.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/run/filled_holes.h"
#include "wheelwright/run/nucleated_shape.h"
#include "wheelwright/run/on_other_grid.h"
#include "wheelwright/run/own_drawings.h"
#include "wheelwright/run/provenance.h"
#include "wheelwright/run/replacements.h"

namespace wheelwright {
namespace {

/// Between two progress notices of a slow contact problem.
constexpr double seconds_between_signs = 2;

constexpr const char* case_file = "case.toml";

template <int dim>
Trial<dim> failed_trial(int iteration, const LevelSet<dim>& shape, const Failure& failure) {
  return {.iteration = iteration,
          .halvings = 0,
          .step = 0,
          .max_velocity = 0,
          .evolution_seconds = 0,
          .shape = shape,
          .measure = 0,
          .verdict = Verdict::failed,
          .failure = failure};
}

}  // namespace

template <int dim>
RunLoop<dim>::RunLoop(const std::filesystem::path& folder, Study<dim> study, const Observers<dim>& observers,
                      CommandQueue& commands, OnEnd on_end)
    : folder_(folder),
      observers_(observers),
      commands_(commands),
      on_end_(on_end),
      stop_file_(std::make_shared<StopFile>(folder)),
      work_(make_work(std::move(study))) {
  commands_.add_source([file = stop_file_] { return (*file)(); });
}

template <int dim>
std::shared_ptr<const typename RunLoop<dim>::Work> RunLoop<dim>::make_work(Study<dim> study) {
  const Interrupt interrupt([this] { return commands_.waiting_stops() > stops_before_; }, contact_progress());
  auto evaluate = evaluate_of(study, interrupt);
  ShapeOptimizer<dim> optimizer(study.initial.lattice, study.evolution, study.optimizer, evaluate);
  return std::make_shared<const Work>(Work{std::move(study), std::move(evaluate), std::move(optimizer)});
}

template <int dim>
Interrupt::Progress RunLoop<dim>::contact_progress() {
  return [this](const ContactProgress& progress) {
    if (sign_of_life_.seconds() < seconds_between_signs) return;
    sign_of_life_.lap();
    notify(ContactAdvanced{progress});
  };
}

template <int dim>
RunResult<dim> RunLoop<dim>::begin() {
  write_case_file();
  notify(RunStarted{});
  if (const auto fault = filled_holes(work_->study.initial, work_->study.evolution))
    return end_without_a_shape(*fault);
  stops_before_ = commands_.waiting_stops();
  auto state = work_->optimizer.start(
      work_->study.initial,
      [this](const Trial<dim>& trial, const OptimizationState<dim>& first) { observe(trial, first); });
  stops_before_ = 0;
  if (!state) return end_without_a_shape(state.failure());
  state_ = *std::move(state);
  return advance();
}

template <int dim>
RunResult<dim> RunLoop<dim>::resume(const Checkpoint<dim>& checkpoint) {
  write_case_file();
  state_ = checkpoint.state;
  initial_ = checkpoint.initial;
  nucleation_ = checkpoint.nucleation;
  elapsed_ = checkpoint.elapsed_seconds;
  notify(RunStarted{.resumed_after = state_->iteration});
  if (on_end_ == OnEnd::wait) restart_search();  // a checkpoint has no solution to show
  return advance();
}

template <int dim>
RunResult<dim> RunLoop<dim>::advance() {
  const auto observer = [this](const Trial<dim>& trial, const OptimizationState<dim>& state) {
    observe(trial, state);
  };
  if (begins_on_coarser_grid()) begin_on_coarser_grid();
  while (!is_stopped_) {
    const auto work = work_;  // a command may replace it while it is in use
    const auto reason = work->optimizer.advance(*state_, observer, [this] { return must_yield(); });
    if (!reason) continue;
    if (*reason == StopReason::stop_requested) {
      must_yield();  // an evaluation was interrupted: by a command to stop
      continue;
    }
    if (nucleates(*reason)) continue;
    if (work_->study.level == 0 && on_end_ == OnEnd::finish) return end(*reason);
    if (work_->study.level == 0) {
      wait_for_more(*reason);
      continue;
    }
    // If no shapes are left for finer grids, the results are still those of the case's own grid.
    const auto failure = move_to_grid(*reason == StopReason::iterations ? 0 : work_->study.level - 1);
    if (failure && failure->reason != FailureReason::interrupted) return end_between_grids(*failure);
    if (failure) must_yield();
  }
  return end(StopReason::stop_requested);
}

/// At the end of a search: judges the newest holes, and creates others where they pay. Returns whether the
/// search continues.
template <int dim>
bool RunLoop<dim>::nucleates(StopReason reason) {
  const Study<dim>& study = work_->study;
  if (study.source.optimizer.nucleation == NucleationTime::never || nucleation_.is_over) return false;
  if (nucleation_.before && !has_paid<dim>(study.optimizer, *nucleation_.before, state_->evaluation))
    return undo_nucleation(reason);
  nucleation_.before.reset();
  return (reason == StopReason::converged || reason == StopReason::no_descent) && makes_holes();
}

template <int dim>
bool RunLoop<dim>::makes_holes() {
  if constexpr (dim == 2) {
    const Study<2>& study = work_->study;
    const Evolver<2>& evolver = work_->optimizer.evolver();
    auto made = nucleated_shape(study, work_->evaluate, evolver, *state_);
    if (!made) return continues_after(made.failure());
    if (!*made) {
      nucleation_.is_over = true;
      return false;
    }
    std::optional<Trial<2>> trial;
    auto anew = state_at(work_->optimizer, (*made)->shape, trial);
    if (!anew) return continues_after(anew.failure());
    trial->events = evolver.changes(state_->shape, anew->shape);
    nucleation_.before = before_nucleation(study.optimizer, *state_);
    state_ = *std::move(anew);
    notify(ShapeReplaced{(*made)->text});
    observe(*trial, *state_);
    return true;
  }
  return false;
}

/// Returns to the shape before the newest holes, with which the search ends. Holes that ran out of shapes may
/// be created again if the run is extended.
template <int dim>
bool RunLoop<dim>::undo_nucleation(StopReason reason) {
  std::optional<Trial<dim>> trial;
  auto anew = state_at(work_->optimizer, nucleation_.before->shape, trial);
  if (!anew) return continues_after(anew.failure());
  trial->events = work_->optimizer.evolver().changes(state_->shape, anew->shape);
  const std::string text =
      fmt::format("nucleation undone: it ended at {:.6g}, not below {:.6g}",
                  work_->optimizer.objective_of(state_->evaluation), nucleation_.before->objective);
  nucleation_ = {.before = {}, .is_over = reason != StopReason::iterations};
  state_ = *std::move(anew);
  notify(ShapeReplaced{text});
  observe(*trial, *state_);
  return false;
}

/// After a failure to create or undo holes: whether it was due to a command to stop. Otherwise no more are
/// created.
template <int dim>
bool RunLoop<dim>::continues_after(const Failure& failure) {
  if (failure.reason == FailureReason::interrupted) {
    must_yield();
    return true;
  }
  nucleation_.is_over = true;
  notify(CommandDone{nullptr, fmt::format("nucleation: {}: {}", to_string(failure.reason), failure.detail),
                     false});
  return false;
}

/// Also true for a run that was stopped before the descent started.
template <int dim>
bool RunLoop<dim>::begins_on_coarser_grid() const {
  const Case& c = work_->study.source;
  return work_->study.level == 0 && state_->iteration == 0 && c.optimizer.coarse_levels > 0 &&
         c.optimizer.iterations > 0;
}

/// The coarsest grid on which the initial shape can be solved.
template <int dim>
void RunLoop<dim>::begin_on_coarser_grid() {
  for (int level = work_->study.source.optimizer.coarse_levels; level > 0; --level) {
    const auto failure = move_to_grid(level);
    if (!failure) return;
    if (failure->reason == FailureReason::interrupted) {
      must_yield();
      return;
    }
    notify(CommandDone{nullptr,
                       fmt::format("{}: {}: {}", grid_text(on_coarser_grid(work_->study.source, level)),
                                   to_string(failure->reason), failure->detail),
                       false});
  }
}

/// Continues with the current shape on the grid of a level. If that fails, nothing has changed.
template <int dim>
std::optional<Failure> RunLoop<dim>::move_to_grid(int level) {
  auto study = make_study<dim>(work_->study.source, level);
  if (!study) return study.failure();
  const auto work = make_work(*std::move(study));
  auto moved = on_other_grid(*state_, work->study.initial.lattice, work->optimizer.evolver());
  if (!moved) return moved.failure();
  std::optional<Trial<dim>> trial;
  auto anew = work->optimizer.restart(
      moved->state, [&](const Trial<dim>& seen, const OptimizationState<dim>&) { trial = seen; });
  if (!anew) return anew.failure();
  trial->events = std::move(moved->events);
  work_ = work;
  state_ = *std::move(anew);
  notify(GridChanged{grid_text(work_->study.computed())});
  observe(*trial, *state_);
  return {};
}

template <int dim>
RunResult<dim> RunLoop<dim>::end(StopReason reason) {
  save();
  stop_file_->remove();
  const Interrupt interrupt([this] { return commands_.waiting_stops() > 0; }, contact_progress());
  const auto results = final_results(work_->study, *initial_, *state_, solved_, interrupt);
  if (results.is_interrupted && reason != StopReason::gave_up)
    reason = StopReason::stop_requested;  // a resumed run completes them
  const RunEnded<dim> ended{reason,           &*state_,      results.shown.get(), results.solver.get(),
                            &results.summary, failed_trials_};
  if (results.shown)
    for_each_position<dim>(*results.solver, *results.shown,
                           [&](int position, const PositionFields<dim>& fields) {
                             notify(PositionShown<dim>{ended, position, fields});
                           });
  notify(ended);
  RunResult<dim> of_run = result(reason);
  of_run.summary = results.summary;
  if (reason != StopReason::stop_requested) of_run.findings = findings_at_the_end(results.own);
  return of_run;
}

template <int dim>
RunResult<dim> RunLoop<dim>::end_without_a_shape(const Failure& failure) {
  stop_file_->remove();
  if (failure.reason == FailureReason::interrupted) {
    notify(RunEnded<dim>{StopReason::stop_requested, nullptr, nullptr, nullptr, nullptr, {}});
    return result(StopReason::stop_requested);
  }
  failed_trials_ = {failed_trial(0, work_->study.initial, failure)};
  notify(RunEnded<dim>{StopReason::failed_start, nullptr, nullptr, nullptr, nullptr, failed_trials_});
  return result(StopReason::failed_start);
}

/// The shape cannot be computed on the next grid: the run gives up with the current one.
template <int dim>
RunResult<dim> RunLoop<dim>::end_between_grids(const Failure& failure) {
  failed_trials_ = {failed_trial(state_->iteration, state_->shape, failure)};
  return end(StopReason::gave_up);
}

template <int dim>
RunResult<dim> RunLoop<dim>::result(StopReason reason) const {
  return {.reason = reason,
          .state = state_,
          .initial = initial_,
          .failed_trials = failed_trials_,
          .findings = {},
          .summary = {},
          .elapsed_seconds = elapsed_,
          .is_approaching = state_ && is_approaching(work_->study.optimizer, *state_)};
}

template <int dim>
std::vector<Finding> RunLoop<dim>::findings_at_the_end(const SolvedStates<dim>& solution) {
  const auto& expectations = work_->study.source.expectations;
  if (expectations.empty()) return {};
  Checkpoint<dim> noted{.provenance = {},
                        .state = *state_,
                        .initial = *initial_,
                        .nucleation = {},
                        .found = {},
                        .history = {},
                        .elapsed_seconds = 0,
                        .finished = {}};
  for (const auto& observer : observers_) observer->add_to(noted);
  return findings<dim>(expectations, noted.found, *work_->study.solver, work_->study.load_cases, *state_,
                       solution);
}

template <int dim>
void RunLoop<dim>::observe(const Trial<dim>& trial, const OptimizationState<dim>& state) {
  sign_of_life_.lap();
  const double seconds = watch_.lap();
  elapsed_ += seconds;
  if (trial.verdict == Verdict::accepted) {
    failed_trials_.clear();
    if (!initial_)
      initial_ =
          InitialShape<dim>{state.shape, work_->optimizer.objective_of(state.evaluation), state.measure};
    const Case& c = work_->study.source;
    const bool is_initial =
        state.iteration == 0 && work_->study.level == 0 && state.shape.values == initial_->shape.values;
    if (is_initial && trial.solution && tread_levels_of_results(c) == tread_levels(c))
      solved_.initial = described(*work_->study.solver, work_->study.load_cases, state.shape, state.measure,
                                  SolvedStates<dim>(trial.solution));
    solved_.last = reason_to_stop(work_->study.optimizer, state) ? trial.solution : nullptr;
  } else if (trial.verdict == Verdict::failed) {
    failed_trials_.push_back(trial);
    failed_trials_.back().solution.reset();
    failed_trials_.back().other_solutions.clear();
  }
  notify(TrialDone<dim>{trial, state, seconds});
  elapsed_ += watch_.lap();
}

template <int dim>
void RunLoop<dim>::notify(const Event<dim>& event) {
  const RunView<dim> view{.folder = folder_,
                          .study = work_->study,
                          .evolver = work_->optimizer.evolver(),
                          .initial = initial_ ? &*initial_ : nullptr,
                          .nucleation = nucleation_,
                          .elapsed_seconds = elapsed_,
                          .can_undo = !past_.empty(),
                          .observers = observers_};
  for (const auto& observer : observers_) (*observer)(event, view);
}

template <int dim>
void RunLoop<dim>::write_case_file() const {
  write_drawings(folder_, work_->study.source);
  write_atomically(folder_ / case_file,
                   fmt::format("# {}\n\n{}", program_text(), to_toml(work_->study.source)));
}

/// Executes the waiting commands; returns whether the loop must return, to end or to continue with another
/// case or shape.
template <int dim>
bool RunLoop<dim>::must_yield() {
  const int changes = changes_;
  while (!is_stopped_) {
    const auto command = commands_.take();
    if (!command) break;
    execute(*command);
  }
  wait_while_paused();
  return is_stopped_ || changes_ != changes;
}

template <int dim>
bool RunLoop<dim>::is_paused() const {
  return !is_stopped_ && pause_at_ && state_->iteration >= *pause_at_;
}

template <int dim>
void RunLoop<dim>::wait_while_paused() {
  if (!is_paused()) return;
  elapsed_ += watch_.lap();
  save();
  notify(RunWaits{});
  while (is_paused()) execute(commands_.wait());
  notify(RunProceeds{});
  watch_.lap();  // the pause does not count
}

/// When the loop has a reason to end, waits until a command gives it something to do. After a command to
/// pause it keeps waiting through further changes.
template <int dim>
void RunLoop<dim>::wait_for_more(StopReason reason) {
  elapsed_ += watch_.lap();
  save();
  has_ended_by_itself_ = true;
  notify(RunWaits{reason});
  while (!is_stopped_ && has_ended_by_itself_) {
    const bool was_paused = is_paused();
    execute(commands_.wait());
    if (has_ended_by_itself_ && is_paused() && !was_paused) notify(RunWaits{});
  }
  has_ended_by_itself_ = false;
  notify(RunProceeds{});
  watch_.lap();
}

template <int dim>
void RunLoop<dim>::execute(const Command& command) {
  const CommandResult executed = std::visit(
      [this](const auto& c) -> CommandResult { return c.execute(static_cast<RunControl&>(*this)); }, command);
  if (executed)
    notify(CommandDone{&command, *executed, true});
  else
    notify(CommandDone{&command, executed.failure().reason, false});
}

template <int dim>
void RunLoop<dim>::pause(int after_shapes) {
  const int from = after_shapes > 0 ? std::max(state_->iteration, pause_at_.value_or(0)) : state_->iteration;
  pause_at_ = from + after_shapes;
  if (after_shapes > 0 && has_ended_by_itself_) restart_search();
}

template <int dim>
void RunLoop<dim>::continue_run() {
  pause_at_.reset();
  if (has_ended_by_itself_) restart_search();
}

/// Discards the history of the objective, and thus the reason why the run waits.
template <int dim>
void RunLoop<dim>::restart_search() {
  replace_shape(state_->shape, "one more search for better shapes");
}

template <int dim>
std::optional<Refusal> RunLoop<dim>::change_case(const Case& changed, const std::string& what) {
  Past past = before(what);
  if (auto refusal = work_on(changed, state_->shape, what)) return refusal;
  remember(std::move(past));
  return {};
}

template <int dim>
std::vector<Point> RunLoop<dim>::hole_at(const Point& point) const {
  if constexpr (dim == 2)
    return hole_contour(state_->shape, point);
  else
    return {};
}

template <int dim>
std::optional<Refusal> RunLoop<dim>::draw(std::span<const Stroke> strokes, const std::string& what) {
  const auto shape =
      drawn_over(state_->shape, strokes, work_->optimizer.evolver(),
                 work_->study.optimizer.largest_island * sector_measure<dim>(work_->study.grid()));
  if (!shape) return shape.failure();
  Past past = before(what);
  if (auto refusal = replace_shape(*shape, what)) return refusal;
  remember(std::move(past));
  return {};
}

template <int dim>
std::optional<Refusal> RunLoop<dim>::take_shape(const std::filesystem::path& file, const std::string& what) {
  const auto shape = shape_of_file(file, state_->shape.lattice, work_->optimizer.evolver());
  if (!shape) return shape.failure();
  Past past = before(what);
  if (auto refusal = replace_shape(*shape, what)) return refusal;
  remember(std::move(past));
  return {};
}

template <int dim>
std::optional<Refusal> RunLoop<dim>::reset() {
  const std::string what = "back to the initial shape";
  Past past = before(what);
  if (auto refusal = replace_shape(initial_->shape, what)) return refusal;
  remember(std::move(past));
  return {};
}

template <int dim>
Expected<std::string, Refusal> RunLoop<dim>::undo() {
  if (past_.empty()) return Refusal{"there is nothing to undo"};
  const Past& last = past_.back();
  const std::string what = "undo";
  if (auto refusal = last.source == work_->study.source ? replace_shape(last.shape, what)
                                                        : work_on(last.source, last.shape, what))
    return *std::move(refusal);
  std::string change = std::move(past_.back().change);
  past_.pop_back();
  return change;
}

template <int dim>
void RunLoop<dim>::remember(Past past) {
  constexpr std::size_t most = 100;
  past_.push_back(std::move(past));
  if (past_.size() > most) past_.pop_front();
}

/// Evaluates another shape from the present state with that optimizer; returns its trial.
template <int dim>
Expected<OptimizationState<dim>> RunLoop<dim>::state_at(const ShapeOptimizer<dim>& optimizer,
                                                        const LevelSet<dim>& shape,
                                                        std::optional<Trial<dim>>& trial) const {
  OptimizationState<dim> from = *state_;
  from.shape = regrid(shape, state_->shape.lattice);  // an earlier shape may be on another grid
  return optimizer.restart(from,
                           [&](const Trial<dim>& seen, const OptimizationState<dim>&) { trial = seen; });
}

/// Continues from another shape under the same case.
template <int dim>
std::optional<Refusal> RunLoop<dim>::replace_shape(const LevelSet<dim>& shape, const std::string& what) {
  if (shape.values != state_->shape.values) notify(ShapeProposed<dim>{shape});
  std::optional<Trial<dim>> trial;
  stops_before_ = std::numeric_limits<int>::max();  // later commands to stop are executed afterwards
  auto anew = state_at(work_->optimizer, shape, trial);
  stops_before_ = 0;
  if (!anew) return refusal(anew.failure());
  state_ = *std::move(anew);
  nucleation_ = {};
  has_ended_by_itself_ = false;
  ++changes_;
  notify(ShapeReplaced{what});
  observe(*trial, *state_);
  return {};
}

/// Continues under another case, possibly also from another shape.
template <int dim>
std::optional<Refusal> RunLoop<dim>::work_on(const Case& changed, const LevelSet<dim>& shape,
                                             const std::string& what) {
  const auto c = accepted_case(changed, folder_ / case_file);
  if (!c) return c.failure();
  const int level = work_->study.level;
  if (level_of(*c, initial_->shape) != 0 || level_of(*c, state_->shape) != level)
    return Refusal{"the shape is on another grid than the case's"};
  auto study = make_study<dim>(*c, level);
  if (!study) return refusal(study.failure());
  const auto of_initial = level == 0 ? study : make_study<dim>(*c);
  if (!of_initial) return refusal(of_initial.failure());
  // Without interruption: later commands to stop are executed afterwards.
  const auto first = evaluate_of(*of_initial)(initial_->shape, nullptr);
  if (!first) return refusal(first.failure());
  std::optional<Trial<dim>> trial;
  auto anew = state_at(optimizer_of(*study), shape, trial);
  if (!anew) return refusal(anew.failure());

  work_ = make_work(*std::move(study));
  solved_.initial.reset();
  initial_->objective = first->evaluation.function("objective").value;
  state_ = *std::move(anew);
  nucleation_ = {};
  has_ended_by_itself_ = false;
  ++changes_;
  notify(CaseChanged{what});
  observe(*trial, *state_);  // saved by the checkpointer, before case.toml says so
  write_case_file();
  return {};
}

template class RunLoop<2>;
template class RunLoop<3>;

}  // namespace wheelwright
