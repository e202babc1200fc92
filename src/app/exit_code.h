#pragma once

namespace wheelwright {

/// What the program tells its caller.
enum ExitCode {
  exit_done = 0,
  exit_bug = 1,
  exit_usage = 2,         ///< wrong command line or case
  exit_no_solution = 3,   ///< the solver gave up
  exit_refused = 4,       ///< e.g. to overwrite a file
  exit_input_output = 5,  ///< a file or library could not be read or written
  exit_unexpected = 6,    ///< the run is done, but something that the case expects of it is not so
};

}  // namespace wheelwright
