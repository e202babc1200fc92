#pragma once

#include <memory>

#include "wheelwright/app/progress.h"
#include "wheelwright/run/session/run.h"

namespace wheelwright {

/// How much of a run is printed on standard error.
enum class Detail {
  progress,     ///< a bar, warnings, and the effects of commands
  every_trial,  ///< also every rejected trial with the reason, merging or vanishing holes, bounds, grids
};

/// Prints on the terminal what happens in the run. To be called once, before the run is executed.
template <int dim>
void show_on_terminal(Run<dim>& run, Detail detail);

}  // namespace wheelwright
