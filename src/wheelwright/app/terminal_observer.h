#pragma once

#include <memory>

#include "wheelwright/app/progress.h"
#include "wheelwright/run/run.h"

namespace wheelwright {

/// How much of a run is told on standard error.
enum class Detail {
  progress,     ///< a bar, warnings, and what commands do
  every_trial,  ///< besides, every rejected trial and why, holes that merge or vanish, bounds, grids
};

/// Tells on the terminal what happens in the run. To be called once, before it is executed.
template <int dim>
void tell_on_terminal(Run<dim>& run, Detail detail);

}  // namespace wheelwright
