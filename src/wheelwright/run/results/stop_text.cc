#include "wheelwright/run/results/stop_text.h"

namespace wheelwright {

std::string text(StopReason reason) {
  switch (reason) {
    case StopReason::converged:
      return "converged within optimizer.tolerance";
    case StopReason::iterations:
      return "ended after the given number of shapes";
    case StopReason::no_descent:
      return "ended, no step gives a better shape";
    case StopReason::gave_up:
      return "gave up, no trial shape could be computed";
    case StopReason::failed_start:
      return "the initial shape could not be computed";
    case StopReason::stop_requested:
      return "stopped";
  }
  return "";
}

std::string text_of_stop(const std::string& name) {
  for (const StopReason reason : {StopReason::converged, StopReason::iterations, StopReason::no_descent,
                                  StopReason::gave_up, StopReason::failed_start, StopReason::stop_requested})
    if (name == to_string(reason)) return text(reason);
  return name;
}

}  // namespace wheelwright
