#include "wheelwright/app/terminal_observer.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/trial_log.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/unlimited.h"
#include "wheelwright/run/observers/run_warnings.h"
#include "wheelwright/run/study/bounded_functions.h"

namespace wheelwright {
namespace {

/// Shows the progress, when bounds are kept, and warnings about the wheel.
template <int dim>
class TerminalObserver : public Observer<dim> {
 public:
  explicit TerminalObserver(std::shared_ptr<Progress> progress) : progress_(std::move(progress)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override {
    if (const auto* started = std::get_if<RunStarted>(&event)) begin(*started, run);
    if (const auto* advanced = std::get_if<ContactAdvanced>(&event))
      progress_->show_step((advanced->for_results ? "results: " : "") + text(advanced->progress),
                           run.elapsed_seconds);
    if (const auto* command = std::get_if<CommandDone>(&event); command && !command->text.empty())
      progress_->note((command->was_executed ? "" : "refused: ") + command->text);
    if (const auto* ended = std::get_if<RunEnded<dim>>(&event); ended && is_normal_end(ended->reason))
      progress_->complete();
    for (const auto& [subject, text] : run_warnings(event, run))
      progress_->note(fmt::format("warning: {}, {}: {}", run.folder.string(), subject, text));
    if (const auto* done = std::get_if<TrialDone<dim>>(&event)) show(*done, run);
    if (std::holds_alternative<RunEnded<dim>>(event)) progress_->end();
  }

 private:
  void begin(const RunStarted& started, const RunView<dim>& run) {
    if (started.resumed_after) return;
    if (const auto change = volume_change_of_saved_shape<dim>(run.study.source))
      progress_->note(text(*change));
  }

  void show(const TrialDone<dim>& done, const RunView<dim>& run) {
    const auto& [trial, state, seconds] = done;
    if (trial.verdict != Verdict::accepted) return;
    tell_bounds(state);
    const PolarGrid<dim>& grid = run.study.grid();
    const int asked = run.study.optimizer.iterations;
    const ShownUnit shown = shown_unit(run.study.source.objective.minimize, run.study.source.wheel);
    progress_->show({.shape = state.iteration,
                     .n_shapes = asked < unlimited_iterations ? std::optional(asked) : std::nullopt,
                     .objective = state.evaluation.function("objective").value * shown.factor,
                     .initial_objective = run.initial->objective * shown.factor,
                     .volume_fraction = volume_fraction(grid, state.measure),
                     .step = trial.step * grid.resolution(),
                     .elapsed_seconds = run.elapsed_seconds,
                     .objective_unit = shown.name});
  }

  /// Prints the bounds that the first shape violates, and when all are kept for the first time.
  void tell_bounds(const OptimizationState<dim>& state) {
    const auto bounds = bound_states(state.evaluation, {});
    const bool are_kept = std::ranges::all_of(bounds, &BoundState::is_kept);
    if (state.iteration == 0) {
      is_violated_ = !are_kept;
      for (const BoundState& bound : bounds)
        if (!bound.is_kept())
          progress_->note("the initial shape violates a bound: " + text(bound, state.shape.lattice.grid()));
    } else if (are_kept && is_violated_) {
      is_violated_ = false;
      progress_->note(fmt::format("shape {}: all bounds are kept", state.iteration));
    }
  }

  static bool is_normal_end(StopReason reason) {
    return reason == StopReason::converged || reason == StopReason::no_descent ||
           reason == StopReason::iterations;
  }

  std::shared_ptr<Progress> progress_;
  bool is_violated_ = false;  ///< a bound by the first shape and all since
};

}  // namespace

template <int dim>
void show_on_terminal(Run<dim>& run, Detail detail) {
  constexpr double seconds_between_lines = 10, of_every_trial = 0;
  const bool shows_all = detail == Detail::every_trial;
  const auto progress = std::make_shared<Progress>(stderr, progress_style(stderr),
                                                   shows_all ? of_every_trial : seconds_between_lines);
  if (shows_all) run.add(std::make_unique<TrialLog<dim>>(progress));
  run.add(std::make_unique<TerminalObserver<dim>>(progress));
}

template decltype(show_on_terminal<2>) show_on_terminal<2>;
template decltype(show_on_terminal<3>) show_on_terminal<3>;

}  // namespace wheelwright
