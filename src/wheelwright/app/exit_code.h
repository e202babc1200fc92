#pragma once

#include <string>

namespace wheelwright {

/// The exit codes of the program; exit_code.cc says what each means.
enum ExitCode {
  exit_done = 0,
  exit_bug = 1,
  exit_usage = 2,
  exit_no_solution = 3,
  exit_refused = 4,
  exit_input_output = 5,
  exit_checkpoint = 6,
  exit_unexpected = 7,
  exit_nothing_saved = 8,
  exit_infeasible = 9,
  exit_hung_up = 129,
  exit_interrupted = 130,
  exit_terminated = 143,
};

/// Says in one line what an exit code means. Empty for other numbers.
std::string meaning_of_exit_code(int code);

/// All of them with their meaning, for --help.
std::string exit_code_list();

}  // namespace wheelwright
