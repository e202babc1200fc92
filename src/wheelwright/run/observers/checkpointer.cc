#include "wheelwright/run/observers/checkpointer.h"

#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/checkpoints/provenance.h"

namespace wheelwright {

template <int dim>
Checkpointer<dim>::Checkpointer(CheckpointFolder folder, const std::optional<Checkpoint<dim>>& resumed)
    : folder_(std::move(folder)) {
  if (!resumed) return;
  elapsed_ = resumed->elapsed_seconds;
  saved_iteration_ = resumed->state.iteration;
}

template <int dim>
void Checkpointer<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (std::holds_alternative<CaseChanged>(event) || std::holds_alternative<ShapeReplaced>(event) ||
      std::holds_alternative<GridChanged>(event))
    saved_iteration_.reset();
  if (const auto* done = std::get_if<TrialDone<dim>>(&event)) {
    if (done->trial.verdict == Verdict::accepted) elapsed_ = run.elapsed_seconds;
    if (is_due(done->state, run.study.source.output)) write(done->state, run, {});
  }
  if (const auto* request = std::get_if<SaveRequested<dim>>(&event))
    if (saved_iteration_ != request->state.iteration) write(request->state, run, {});
  if (const auto* ended = std::get_if<RunEnded<dim>>(&event))
    if (ended->solution && ended->reason != StopReason::gave_up &&
        ended->reason != StopReason::stop_requested)
      write(*ended->state, run, ended->reason);
}

template <int dim>
bool Checkpointer<dim>::is_due(const OptimizationState<dim>& state, const Output& output) const {
  const auto& [every, seconds] = std::pair(output.checkpoint_every, output.checkpoint_seconds);
  return !saved_iteration_ || (every > 0 && state.iteration - *saved_iteration_ >= every) ||
         (seconds > 0 && since_saved_.seconds() >= seconds);
}

template <int dim>
void Checkpointer<dim>::write(const OptimizationState<dim>& state, const RunView<dim>& run,
                              std::optional<StopReason> finished) {
  Checkpoint<dim> checkpoint{.provenance = provenance(run.study.source),
                             .state = state,
                             .initial = *run.initial,
                             .nucleation = run.nucleation,
                             .found = {},
                             .history = {},
                             .elapsed_seconds = 0,
                             .finished = finished,
                             .tolerance = run.study.optimizer.tolerance};
  for (const auto& observer : run.observers) observer->add_to(checkpoint);
  // Before the checkpoint: after that of the end, no resumed run would write it again.
  write_atomically(run.folder / saved_shape_file, level_set_file(state.shape));
  folder_.save(state.iteration, checkpoint_file(checkpoint));
  saved_iteration_ = state.iteration;
  since_saved_.lap();
}

template class Checkpointer<2>;
template class Checkpointer<3>;

}  // namespace wheelwright
