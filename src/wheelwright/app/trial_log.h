#pragma once

#include <memory>

#include "wheelwright/app/progress.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Prints the course of the search: rejected trials with the reason, changes of topology and grids.
template <int dim>
class TrialLog : public Observer<dim> {
 public:
  explicit TrialLog(std::shared_ptr<Progress> progress) : progress_(std::move(progress)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  void begin(const Study<dim>& study);
  void tell_trial(const TrialDone<dim>& done);

  std::shared_ptr<Progress> progress_;
};

}  // namespace wheelwright
