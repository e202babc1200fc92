#pragma once

#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Writes summary.json: the numbers of the run, before and after, or why they cannot be computed.
template <int dim>
class SummaryFile : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
};

}  // namespace wheelwright
