#pragma once

#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Writes summary.json: what the run made of the initial shape, in numbers, or why that cannot be computed.
template <int dim>
class SummaryFile : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
};

}  // namespace wheelwright
