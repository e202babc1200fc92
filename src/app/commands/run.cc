#include "app/commands/run.h"

#include <fmt/format.h>

#include "app/exit_code.h"

namespace wheelwright {

int run_command(const Case&, const RunOptions&) {
  fmt::print(stderr, "wheelwright run: not built yet\n");
  return exit_bug;
}

}  // namespace wheelwright
