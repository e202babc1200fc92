#include "wheelwright/app/event_output.h"

#include <cstdio>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"

namespace wheelwright {

void EventOutput::write(const std::string& line) const {
  print("{}\n", line);
  std::fflush(stdout);
}

int EventOutput::end(int exit_code) const {
  write(end_line(reason_, exit_code, meaning_of_exit_code(exit_code)));
  return exit_code;
}

}  // namespace wheelwright
