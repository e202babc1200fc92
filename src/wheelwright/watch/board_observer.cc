#include "wheelwright/watch/board_observer.h"

namespace wheelwright {

void BoardObserver::operator()(const Event<2>& event, const RunView<2>& run) {
  if (std::holds_alternative<CaseChanged>(event)) source_.reset();
  if (const auto* done = std::get_if<TrialDone<2>>(&event))
    if (done->trial.verdict == Verdict::accepted && done->trial.solution) show(*done, run);
  if (const auto* waits = std::get_if<RunWaits>(&event))
    board_->update([&](BoardView& view) {
      view.activity = waits->reason ? Activity::settled : Activity::paused;
      view.reason = waits->reason;
    });
  if (std::holds_alternative<RunProceeds>(event))
    board_->update([](BoardView& view) {
      view.activity = Activity::computing;
      view.reason.reset();
    });
  if (const auto* done = std::get_if<CommandDone>(&event))
    board_->update([&](BoardView& view) {
      view.message = done->text;
      view.is_refusal = !done->was_obeyed;
      view.can_undo = run.can_undo;
    });
  if (const auto* ended = std::get_if<RunEnded<2>>(&event))
    board_->update([&](BoardView& view) {
      view.activity = Activity::ended;
      view.reason = ended->reason;
    });
}

void BoardObserver::show(const TrialDone<2>& done, const RunView<2>& run) {
  if (!source_) source_ = std::make_shared<const Case>(run.study.source);
  const OptimizationState<2>& state = done.state;
  auto shape =
      std::make_shared<WatchedShape>(WatchedShape{.source = source_,
                                                  .solver = run.study.solver,
                                                  .solution = done.trial.solution,
                                                  .psi = state.shape,
                                                  .number = state.iteration,
                                                  .objective = state.evaluation.function("objective").value,
                                                  .terms = state.evaluation.terms,
                                                  .measures = state.evaluation.measures,
                                                  .measure = state.measure,
                                                  .target_measure = state.target_measure});
  if (board_->view().activity == Activity::starting)
    board_->update([](BoardView& view) { view.activity = Activity::computing; });
  board_->show(std::move(shape));
}

}  // namespace wheelwright
