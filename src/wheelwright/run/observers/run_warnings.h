#pragma once

#include <string>
#include <vector>

#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// What is doubtful about a run.
struct RunWarning {
  std::string subject;  ///< e.g. "initial shape", "last shape", or a stage of the run
  std::string text;     ///< one line
};

/// The warnings that an event of a run gives rise to.
template <int dim>
std::vector<RunWarning> run_warnings(const Event<dim>& event, const RunView<dim>& run);

}  // namespace wheelwright
