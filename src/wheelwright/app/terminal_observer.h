#pragma once

#include "wheelwright/app/progress.h"
#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Tells on the terminal what happens in a run: progress, rejected trials, commands.
template <int dim>
class TerminalObserver : public Observer<dim> {
 public:
  TerminalObserver() : progress_(stderr, progress_style(stderr)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  void begin(const RunStarted& started, const RunView<dim>& run);
  void show(const TrialDone<dim>& done, const RunView<dim>& run);
  void note_bounds(const OptimizationState<dim>& state);

  /// Tells when a solution is beyond what linear elasticity describes.
  void warn(const DeformationSize& size);

  Progress progress_;
  bool were_kept_ = true;  ///< the bounds, by the last shape seen
};

}  // namespace wheelwright
