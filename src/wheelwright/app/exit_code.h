#pragma once

namespace wheelwright {

/// The exit codes of the program. main.cc lists them in --help.
enum ExitCode {
  exit_done = 0,
  exit_bug = 1,
  exit_usage = 2,         ///< wrong command line, or a case that is wrong or cannot be read
  exit_no_solution = 3,   ///< the solver gave up
  exit_refused = 4,       ///< would overwrite, shared folder, faulty outline, too little memory, no documents
  exit_input_output = 5,  ///< a file could not be written
  exit_checkpoint = 6,    ///< no usable checkpoint
  exit_unexpected = 7,    ///< the run is done, but an expectation of the case is not met
  exit_nothing_saved = 8,  ///< stopped before the first shape of a run was saved
  exit_infeasible = 9,     ///< the run is done, but its last shape violates a bound of the case
  exit_hung_up = 129,      ///< by SIGHUP, the terminal was closed; the run can be resumed
  exit_interrupted = 130,  ///< by SIGINT; the run can be resumed
  exit_terminated = 143,   ///< by SIGTERM or a file STOP; the run can be resumed
};

}  // namespace wheelwright
