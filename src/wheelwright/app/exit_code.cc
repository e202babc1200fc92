#include "wheelwright/app/exit_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace wheelwright {
namespace {

struct Meaning {
  ExitCode code;
  const char* text;
};

constexpr Meaning meanings[] = {
    {exit_done, "done"},
    {exit_bug, "a bug in the program"},
    {exit_usage, "wrong command line, or the case has errors or cannot be read"},
    {exit_no_solution, "the solver gave up"},
    {exit_refused,
     "refused: a file would be overwritten, another run is writing to the folder, an outline fails its "
     "checks, there is too little memory, or no documents are installed"},
    {exit_input_output, "a file could not be written"},
    {exit_checkpoint, "no usable checkpoint"},
    {exit_unexpected, "done, but the results differ from the expected ones of the case"},
    {exit_nothing_saved, "stopped before the first shape was saved: nothing to resume"},
    {exit_infeasible, "done, but the last shape violates a bound of the case"},
    {exit_hung_up, "stopped by SIGHUP (the terminal was closed); the run can be resumed"},
    {exit_interrupted, "stopped by SIGINT (Ctrl-C); the run can be resumed"},
    {exit_terminated, "stopped by SIGTERM or by a file STOP in the run's folder; the run can be resumed"},
};

}  // namespace

std::string meaning_of_exit_code(int code) {
  const auto found = std::ranges::find(meanings, code, &Meaning::code);
  return found == std::end(meanings) ? "" : found->text;
}

std::string exit_code_list() {
  std::string list = "Exit codes:";
  for (const auto& [code, text] : meanings) list += fmt::format("\n  {:<5}{}", static_cast<int>(code), text);
  return list;
}

}  // namespace wheelwright
