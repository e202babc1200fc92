#include "wheelwright/web/watch/board_observer.h"

namespace wheelwright {

template <int dim>
void BoardObserver<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (std::holds_alternative<CaseChanged>(event) || std::holds_alternative<GridChanged>(event))
    source_.reset();
  if (const auto* done = std::get_if<TrialDone<dim>>(&event))
    if (done->trial.verdict == Verdict::accepted && done->trial.solution) show(*done, run);
  if (const auto* proposed = std::get_if<ShapeProposed<dim>>(&event))
    board_->update([&](BoardView<dim>& view) {
      view.proposed = std::make_shared<const LevelSet<dim>>(proposed->shape);
    });
  if (const auto* waits = std::get_if<RunWaits>(&event))
    board_->update([&](BoardView<dim>& view) {
      view.activity = waits->reason ? Activity::settled : Activity::paused;
      view.reason = waits->reason;
    });
  if (std::holds_alternative<RunProceeds>(event))
    board_->update([](BoardView<dim>& view) {
      view.activity = Activity::computing;
      view.reason.reset();
    });
  if (const auto* done = std::get_if<CommandDone>(&event))
    board_->update([&](BoardView<dim>& view) {
      view.proposed.reset();
      view.message = done->text;
      view.is_refusal = !done->was_executed;
      view.can_undo = run.can_undo;
    });
  if (const auto* failed = std::get_if<StageFailed>(&event))
    board_->update([&](BoardView<dim>& view) {
      view.message = failed->stage + ": " + failed->reason;
      view.is_refusal = true;
    });
  if (const auto* ended = std::get_if<RunEnded<dim>>(&event))
    board_->update([&](BoardView<dim>& view) {
      view.activity = Activity::ended;
      view.reason = ended->reason;
    });
}

template <int dim>
void BoardObserver<dim>::show(const TrialDone<dim>& done, const RunView<dim>& run) {
  if (!source_ || source_->layers != run.study.source.layers) {  // the run chooses radii of layers
    source_ = std::make_shared<const Case>(run.study.source);
    load_cases_ = std::make_shared<const LoadCases<dim>>(run.study.load_cases);
  }
  const OptimizationState<dim>& state = done.state;
  StatesOfCases<dim> solutions{done.trial.solution};
  solutions.insert(solutions.end(), done.trial.other_solutions.begin(), done.trial.other_solutions.end());
  auto shape = std::make_shared<WatchedShape<dim>>(
      WatchedShape<dim>{.source = source_,
                        .solver = run.study.solver,
                        .load_cases = load_cases_,
                        .solutions = std::move(solutions),
                        .psi = state.shape,
                        .number = state.iteration,
                        .objective = state.evaluation.function("objective").value,
                        .terms = state.evaluation.terms,
                        .measures = state.evaluation.measures,
                        .bounds = bound_states(state.evaluation, {}),
                        .initial_objective = run.initial->objective,
                        .measure = state.measure,
                        .target_measure = state.target_measure});
  if (board_->view().activity == Activity::starting)
    board_->update([](BoardView<dim>& view) { view.activity = Activity::computing; });
  board_->show(std::move(shape));
}

template class BoardObserver<2>;
template class BoardObserver<3>;

}  // namespace wheelwright
