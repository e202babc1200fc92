#include "wheelwright/run/session/run_loop.h"

#include "wheelwright/run/checkpoints/case_file.h"
#include "wheelwright/run/session/run_end.h"
#include "wheelwright/run/study/filled_holes.h"

namespace wheelwright {

template <int dim>
RunLoop<dim>::RunLoop(const std::filesystem::path& folder, Study<dim> study, const Observers<dim>& observers,
                      CommandQueue& commands, OnEnd on_end)
    : folder_(folder),
      commands_(commands),
      on_end_(on_end),
      stop_file_(std::make_shared<StopFile>(folder)),
      session_(std::move(study), at_stop(progress_of_shape()), Interrupt({}, progress_of_shape())),
      journal_(folder, observers, session_),
      schedule_(session_, journal_),
      control_(folder, session_, journal_, commands) {
  commands_.add_source([file = stop_file_] { return (*file)(); });
}

template <int dim>
RunResult<dim> RunLoop<dim>::begin() {
  write_case_file(folder_, session_.study().source);
  journal_.notify(RunStarted{});
  if (const auto failure = start()) {
    stop_file_->remove();
    return end_without_shape(session_, journal_, *failure);
  }
  return run();
}

template <int dim>
std::optional<Failure> RunLoop<dim>::start() {
  const auto bench = session_.bench();
  const Study<dim>& study = bench->study;
  if (auto failure = filled_holes(study.initial, study.evolution)) return failure;
  std::optional<Trial<dim>> trial;
  const auto optimizer = bench->optimizer.with(evaluate_of(study, at_later_stop()));
  auto first = optimizer.start(study.initial,
                               [&](const Trial<dim>& seen, const OptimizationState<dim>&) { trial = seen; });
  if (!first) return first.failure();
  session_.begin(*std::move(first));
  journal_.record(*trial);
  return {};
}

template <int dim>
RunResult<dim> RunLoop<dim>::resume(const Checkpoint<dim>& checkpoint) {
  write_case_file(folder_, session_.study().source);
  session_.resume(checkpoint);
  journal_.add_seconds(checkpoint.elapsed_seconds);
  journal_.notify(RunStarted{.resumed_after = session_.state().iteration});
  if (on_end_ == OnEnd::wait) show_resumed_shape();
  return run();
}

/// Solves the shape, for a checkpoint has no solution to show.
template <int dim>
void RunLoop<dim>::show_resumed_shape() {
  if (const auto refusal = control_.search_again())
    journal_.notify(StageFailed{"the resumed shape", refusal->reason});
}

template <int dim>
RunResult<dim> RunLoop<dim>::run() {
  if (schedule_.begin() == Next::obey) control_.obey();
  while (!control_.is_stopped()) {
    const auto reason = advance();
    if (!reason) continue;
    const auto next = schedule_.after(*reason);
    if (!next) return give_up(next.failure());
    if (*next == Next::obey) control_.obey();
    if (*next != Next::end) continue;
    if (on_end_ == OnEnd::finish) return end(*reason);
    control_.wait_for_more(*reason);
  }
  return end(StopReason::stop_requested);
}

/// Proceeds to the next accepted shape. If there is none, returns why the search ends, unless commands
/// decided otherwise.
template <int dim>
std::optional<StopReason> RunLoop<dim>::advance() {
  const auto bench = session_.bench();  // a command may replace it while it is in use
  const auto reason = bench->optimizer.advance(
      session_.state(), [this](const Trial<dim>& trial, const OptimizationState<dim>&) { record(trial); },
      [this] { return control_.obey(); });
  if (reason != StopReason::stop_requested) return reason;
  control_.obey();  // a command to stop may have ended an evaluation
  return {};
}

/// The case has the radii of the newest shape, also in its file.
template <int dim>
void RunLoop<dim>::record(const Trial<dim>& trial) {
  const bool has_moved = session_.follow_radii();
  journal_.record(trial);
  if (has_moved) write_case_file(folder_, session_.study().source);
}

/// The shape cannot be computed on the next grid: the run ends with the current one.
template <int dim>
RunResult<dim> RunLoop<dim>::give_up(const Failure& failure) {
  journal_.set_failed(session_.state().iteration, session_.state().shape, failure);
  return end(StopReason::gave_up);
}

template <int dim>
RunResult<dim> RunLoop<dim>::end(StopReason reason) {
  control_.save();
  stop_file_->remove();
  return end_run(session_, journal_, reason, at_stop(progress_of_results()));
}

template <int dim>
Interrupt RunLoop<dim>::at_stop(Interrupt::Progress progress) {
  return Interrupt([this] { return commands_.waiting_stops() > 0; }, std::move(progress));
}

/// Commands to stop that are waiting already let the evaluation be completed.
template <int dim>
Interrupt RunLoop<dim>::at_later_stop() {
  return Interrupt(
      [this, waiting = commands_.waiting_stops()] { return commands_.waiting_stops() > waiting; },
      progress_of_shape());
}

template <int dim>
Interrupt::Progress RunLoop<dim>::progress_of_shape() {
  return [this](const ContactProgress& progress) { journal_.show({progress, false}); };
}

template <int dim>
Interrupt::Progress RunLoop<dim>::progress_of_results() {
  return [this](const ContactProgress& progress) { journal_.show({progress, true}); };
}

template class RunLoop<2>;
template class RunLoop<3>;

}  // namespace wheelwright
