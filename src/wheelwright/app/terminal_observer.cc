#include "wheelwright/app/terminal_observer.h"

#include <fmt/format.h>

#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/trial_log.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/unlimited.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/run/study/feature_warnings.h"
#include "wheelwright/run/study/roughness_warning.h"

namespace wheelwright {
namespace {

/// Shows the progress, and warnings about the wheel.
template <int dim>
class TerminalObserver : public Observer<dim> {
 public:
  explicit TerminalObserver(std::shared_ptr<Progress> progress) : progress_(std::move(progress)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override {
    if (const auto* started = std::get_if<RunStarted>(&event)) begin(*started, run);
    if (const auto* done = std::get_if<TrialDone<dim>>(&event)) show(*done, run);
    if (const auto* advanced = std::get_if<ContactAdvanced>(&event))
      progress_->show_step(text(advanced->progress), run.elapsed_seconds);
    if (const auto* command = std::get_if<CommandDone>(&event); command && !command->text.empty())
      progress_->note((command->was_executed ? "" : "refused: ") + command->text);
    if (const auto* failed = std::get_if<StageFailed>(&event))
      warn(run, failed->stage.c_str(), failed->reason);
    if (const auto* ended = std::get_if<RunEnded<dim>>(&event)) end(*ended, run);
  }

 private:
  void begin(const RunStarted& started, const RunView<dim>& run) {
    if (started.resumed_after) return;
    if (const auto change = volume_change_of_saved_shape<dim>(run.study.source))
      progress_->note(text(*change));
    for (const auto& event : lost_on_the_grid<dim>(run.study.source))
      warn(run, "initial shape", "the grid is too coarse for the holes of the case: " + text(event));
  }

  void show(const TrialDone<dim>& done, const RunView<dim>& run) {
    const auto& [trial, state, seconds] = done;
    if (trial.verdict != Verdict::accepted) return;
    if (state.iteration == 0 && trial.solution)
      warn(run, "initial shape",
           deformation_warning(deformation_size(*run.study.solver, trial.shape, *trial.solution)));
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

  void end(const RunEnded<dim>& ended, const RunView<dim>& run) {
    if (is_normal_end(ended.reason)) progress_->complete();
    if (ended.summary) {
      const DescribedWheel<dim>& wheel = ended.summary->after.wheel;
      if (wheel.loaded) warn(run, "last shape", deformation_warning(wheel.loaded->summary.deformation));
      if (wheel.outline)
        for (const std::string& warning : feature_warnings(run.study.source, *wheel.outline))
          warn(run, "last shape", warning);
      warn(run, "last shape",
           roughness_warning(run.study.source, roughness(wheel), roughness(ended.summary->before.wheel)));
    }
    progress_->end();
  }

  /// Nothing if the text is empty.
  void warn(const RunView<dim>& run, const char* which, const std::string& text) {
    if (!text.empty()) progress_->note(fmt::format("warning: {}, {}: {}", run.folder.string(), which, text));
  }

  static bool is_normal_end(StopReason reason) {
    return reason == StopReason::converged || reason == StopReason::no_descent ||
           reason == StopReason::iterations;
  }

  std::shared_ptr<Progress> progress_;
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
