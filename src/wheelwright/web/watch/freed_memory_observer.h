#pragma once

#include "wheelwright/base/process_settings.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Returns freed memory to the system from time to time, so that it does not accumulate over hours.
template <int dim>
class FreedMemoryObserver : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>&) override {
    constexpr double seconds_between = 5;
    if (!std::holds_alternative<TrialDone<dim>>(event) || since_.seconds() < seconds_between) return;
    give_freed_memory_back();
    since_.lap();
  }

 private:
  Stopwatch since_;
};

}  // namespace wheelwright
