#include "wheelwright/run/checkpointer.h"

#include <fmt/format.h>

#include "wheelwright/run/provenance.h"

namespace wheelwright {

Checkpointer::Checkpointer(const Case& c, CheckpointFolder folder, RunRecorder& recorder, Signals& signals,
                           const std::optional<Checkpoint<2>>& start)
    : output_(c.output),
      folder_(std::move(folder)),
      recorder_(recorder),
      signals_(signals),
      provenance_(provenance(c)) {
  if (!start) return;
  history_ = start->history;
  elapsed_ = start->elapsed_seconds;
  saved_iteration_ = start->state.iteration;
}

void Checkpointer::operator()(const Trial<2>& trial, const OptimizationState<2>& state) {
  if (trial.verdict == Verdict::accepted) {
    history_ = recorder_.history().end();
    elapsed_ = recorder_.elapsed();
  }
  const bool asked = signals_.take_save_request();
  if (asked || is_due(state)) save(state);
  if (asked) recorder_.note(fmt::format("shape {} is saved", state.iteration));
}

bool Checkpointer::is_due(const OptimizationState<2>& state) const {
  const auto& [every, seconds] = std::pair(output_.checkpoint_every, output_.checkpoint_seconds);
  return !saved_iteration_ || (every > 0 && state.iteration - *saved_iteration_ >= every) ||
         (seconds > 0 && since_saved_.seconds() >= seconds);
}

void Checkpointer::save(const OptimizationState<2>& state) {
  if (saved_iteration_ != state.iteration) write(state, {});
}

void Checkpointer::save_finished(const OptimizationState<2>& state, StopReason reason) {
  write(state, reason);
}

void Checkpointer::write(const OptimizationState<2>& state, std::optional<StopReason> finished) {
  recorder_.history().synchronize();
  folder_.save(state.iteration,
               checkpoint_file<2>({provenance_, state, *recorder_.initial(), recorder_.expectations().found(),
                                   history_, elapsed_, finished}));
  saved_iteration_ = state.iteration;
  since_saved_.lap();
}

}  // namespace wheelwright
