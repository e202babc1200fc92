#pragma once

#include <memory>

#include "wheelwright/app/progress.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Prints the course of the search: rejected trials with the reason, changes of topology, bounds and grids.
template <int dim>
class TrialLog : public Observer<dim> {
 public:
  explicit TrialLog(std::shared_ptr<Progress> progress) : progress_(std::move(progress)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  void begin(const Study<dim>& study);
  void tell_trial(const TrialDone<dim>& done);
  void tell_bounds(const OptimizationState<dim>& state);

  std::shared_ptr<Progress> progress_;
  bool were_kept_ = true;  ///< whether the last shape seen kept the bounds
};

}  // namespace wheelwright
