#pragma once

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/checkpoints/checkpoint_folder.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Saves a run: after the first shape, then as often as the case says, on request, and as finished at the
/// end.
template <int dim>
class Checkpointer : public Observer<dim> {
 public:
  Checkpointer(CheckpointFolder folder, const std::optional<Checkpoint<dim>>& resumed);

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
  void add_to(Checkpoint<dim>& checkpoint) override { checkpoint.elapsed_seconds = elapsed_; }

 private:
  bool is_due(const OptimizationState<dim>& state, const Output& output) const;
  void write(const OptimizationState<dim>& state, const RunView<dim>& run,
             std::optional<StopReason> finished);

  CheckpointFolder folder_;
  double elapsed_ = 0;  ///< at the last accepted shape [s]
  std::optional<int> saved_iteration_;
  Stopwatch since_saved_;
};

}  // namespace wheelwright
