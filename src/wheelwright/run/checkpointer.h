#pragma once

#include "wheelwright/run/run_recorder.h"
#include "wheelwright/run/signals.h"
#include "wheelwright/run/checkpoint_folder.h"

namespace wheelwright {

/// Watches the loop and saves it: the first shape, then as often as the case says, and when SIGUSR1 asks. To
/// be called behind the recorder, whose history it saves the end of.
class Checkpointer {
 public:
  /// Goes on after `start`, if there is one. `recorder` and `signals` must outlive this.
  Checkpointer(const Case& c, CheckpointFolder folder, RunRecorder& recorder, Signals& signals,
               const std::optional<Checkpoint<2>>& start);

  /// Throws OutputError.
  void operator()(const Trial<2>& trial, const OptimizationState<2>& state);

  /// Saves the state now, unless it is. Throws OutputError.
  void save(const OptimizationState<2>& state);

  /// Saves that the run ended there by itself and that its results are written. Throws OutputError.
  void save_finished(const OptimizationState<2>& state, StopReason reason);

 private:
  bool is_due(const OptimizationState<2>& state) const;
  void write(const OptimizationState<2>& state, std::optional<StopReason> finished);

  Output output_;
  CheckpointFolder folder_;
  RunRecorder& recorder_;
  Signals& signals_;
  Provenance provenance_;
  HistoryMark history_;  ///< its end at the last accepted shape
  double elapsed_ = 0;   ///< at the last accepted shape [s]
  std::optional<int> saved_iteration_;
  Stopwatch since_saved_;
};

}  // namespace wheelwright
